(** Runs of the kernel's own planners, in generated/Runs.v, with walls, backtracks and unfolding among them, are
    runs of Team.v: of the repaired rule, and of the reel.

    A run is given by its walls and by the bytes that the robots sent. Each byte is decoded; each advance must
    be admitted, each robot that says that it met a wall must have one in its way, and no other; each backtrack
    must take back the last advance that was not; and at the end the robots must be where the kernel has them.

    A listener of Heard.v that gets the bytes alone, and no walls, has the robots there, too. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Message Replay Heard.
From Tautline.generated Require Import Runs.
Import ListNotations.

(** The team move, if they agree on what it was. The base stays. *)
Definition team_move_of (l : list (step * outcome)) : option team_move :=
  if forallb is_back l then Some (Backtrack (Stay :: map fst l))
  else if existsb is_back l then None else Some (Advance (Stay :: map fst l)).

(** Whether just those met a wall that say so. *)
Definition says_so (n : nat) (walls : list edge) (s : listed) (l : list (step * outcome)) : bool :=
  list_eqb Bool.eqb (map is_blocked l)
    (map (fun i => negb (arrives (stands walls) (team_of (places s) i) (fst (nth (pred i) l (Stay, Arrived)))))
         (seq 1 (pred n))).

Fixpoint replayed (rl : rule) (n : nat) (base : cell) (walls : list edge) (s : listed) (sent : list N) : option listed :=
  match sent with
  | [] => Some s
  | number :: sent =>
      match decoded (bytes (pred n) number) with
      | None => None
      | Some l =>
          match team_move_of l with
          | None => None
          | Some m =>
              match next n rl base walls s m with
              | Some t => if says_so n walls s l then replayed rl n base walls t sent else None
              | None => None
              end
          end
      end
  end.

Definition run_of_kernel : Type := nat * cell * list edge * list N * list cell.

(** Where the definitions have the robots at the end of a run, and what they have of it. *)
Definition end_of (rl : rule) (r : run_of_kernel) : option listed :=
  let '(n, base, walls, sent, _) := r in replayed rl n base walls (list_start n base) sent.

Definition is_run (rl : rule) (r : run_of_kernel) : bool :=
  let '(_, _, _, _, last) := r in
  match end_of rl r with Some s => list_eqb cell_eqb (places s) last | None => false end.

Lemma replayed_reachable : forall rl n base walls sent s t, reachable n rl base (stands walls) (state_of s) ->
  replayed rl n base walls s sent = Some t -> reachable n rl base (stands walls) (state_of t).
Proof.
  intros rl n base walls sent; induction sent as [|number sent IH]; intros s t R E; cbn [replayed] in E;
    [now injection E as <-|].
  destruct (decoded _) as [l|]; [|discriminate]. destruct (team_move_of l) as [m|]; [|discriminate].
  destruct (next n rl base walls s m) as [u|] eqn:X; [|discriminate]. destruct (says_so n walls s l);
    [|discriminate].
  eapply IH; [|exact E]. eapply next_reachable; eauto.
Qed.

Definition runs_of_kernel : list (rule * list run_of_kernel) := [(REPAIRED, runs_REPAIRED); (REEL, runs_REEL)].

Lemma all_are_runs : forallb (fun rs => forallb (is_run (fst rs)) (snd rs)) runs_of_kernel = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Lemma list_eqb_cells : forall a b, list_eqb cell_eqb a b = true -> a = b.
Proof.
  intros a; induction a as [|x a IH]; intros [|y b] E; cbn in E; try discriminate; [reflexivity|].
  apply andb_true_iff in E; destruct E as [E F]; apply cell_eqb_spec in E; subst; f_equal; now apply IH.
Qed.

(** Every run of the kernel ends in a state that can be reached by the relation, with the robots where the
    kernel has them. *)
Theorem kernel_runs_are_runs : forall rl rs n base walls sent last, In (rl, rs) runs_of_kernel ->
  In (n, base, walls, sent, last) rs ->
  exists st, reachable n rl base (stands walls) st /\ forall i, pos st i = nth i last (0, 0)%Z.
Proof.
  intros rl rs n base walls sent last I J; pose proof all_are_runs as A; rewrite forallb_forall in A;
    specialize (A _ I); cbn [fst snd] in A; rewrite forallb_forall in A; specialize (A _ J).
  unfold is_run in A; destruct (end_of rl _) as [s|] eqn:E; [|discriminate]; apply list_eqb_cells in A.
  exists (state_of s); split.
  - unfold end_of in E; eapply replayed_reachable; [|exact E]. eexists; apply run_start, alike_start.
  - intros i; cbn; unfold team_of; now rewrite A.
Qed.

Definition hears_all (r : run_of_kernel) : bool :=
  let '(n, base, _, sent, last) := r in
  match hears n (begins n base) (map (bytes (pred n)) sent) with
  | Some k => list_eqb cell_eqb (places (team_state k)) last
  | None => false
  end.

Lemma all_are_heard : forallb (fun rs => forallb hears_all (snd rs)) runs_of_kernel = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(** Who hears the bytes of a run of the kernel, and nothing else, knows where the kernel has the robots. *)
Theorem kernel_runs_are_heard : forall rl rs n base walls sent last, In (rl, rs) runs_of_kernel ->
  In (n, base, walls, sent, last) rs ->
  exists k, hears n (begins n base) (map (bytes (pred n)) sent) = Some k /\ places (team_state k) = last.
Proof.
  intros rl rs n base walls sent last I J; pose proof all_are_heard as A; rewrite forallb_forall in A;
    specialize (A _ I); cbn [snd] in A; rewrite forallb_forall in A; specialize (A _ J); unfold hears_all in A.
  destruct (hears _ _ _) as [k|]; [|discriminate]; apply list_eqb_cells in A; eauto.
Qed.
