(** The ends of the kernel's runs in generated/Runs.v, of the repaired rule and of the reel: each ends as Reach.v has
    it, when in the map known by then no unexplored cell is within reach. The map has the walls that the robots have met,
    by their bytes alone, and the border of the area, which they know. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Rings Message Replay Heard Reach Replayed.
Import ListNotations.

(** The border of the area: cells at most N-1 rings from the base. *)
Definition inside (n : nat) (base c : cell) : bool := (ring base c <=? Z.of_nat (n - 1))%Z.
Definition border (n : nat) (base : cell) (e : edge) : bool :=
  negb (Bool.eqb (inside n base (fst e)) (inside n base (beyond (fst e) (if snd e then East else South)))).
Definition map_of (n : nat) (base : cell) (k : known) (e : edge) : bool := border n base e || has (met k) e.

(** A run replayed, with the cells where robots have been. *)
Definition with_cells (n : nat) (s : listed) (seen : list cell) : list cell :=
  fold_left grow (map (team_of (places s)) (seq 0 n)) seen.
Fixpoint explores (rl : rule) (n : nat) (base : cell) (walls : list edge) (s : listed) (seen : list cell)
  (sent : list N) : option (list cell) :=
  match sent with
  | [] => Some seen
  | number :: sent =>
      match replayed rl n base walls s [number] with
      | Some t => explores rl n base walls t (with_cells n t seen) sent
      | None => None
      end
  end.

Lemma next_run : forall n rl base walls past s m t, run n rl base (stands walls) past (state_of s) ->
  next n rl base walls s m = Some t -> run n rl base (stands walls) (pos (state_of t) :: past) (state_of t).
Proof.
  intros n rl base walls past s [steps|steps] t R E; cbn in E.
  - destruct (admitted _ _ _ _ _) eqn:A; [|discriminate]; injection E as <-.
    eapply run_advance; [exact R | exact A | apply alike_advance].
  - destruct (made_so_far s) as [|pl rest] eqn:G; [discriminate|].
    destruct (list_eqb _ _ _); [|discriminate]; injection E as <-.
    eapply run_backtrack; [exact R | cbn; rewrite G; reflexivity | apply alike_backtrack].
Qed.

Definition all_explored (n : nat) (past : list team) (seen : list cell) : Prop :=
  forall c, In c seen -> explored n past c.

Lemma cells_explored : forall n past s seen, all_explored n past seen ->
  all_explored n (pos (state_of s) :: past) (with_cells n s seen).
Proof.
  intros n past s seen A c I; apply grow_spec in I; destruct I as [I|I].
  - destruct (A c I) as [p [i [P E]]]; exists p, i; split; [now right | exact E].
  - apply in_map_iff in I; destruct I as [i [E I]]; apply in_seq in I. exists (pos (state_of s)), i.
    split; [now left|]. split; [lia | exact E].
Qed.

Lemma explores_run : forall rl n base walls sent s seen past seen', run n rl base (stands walls) past (state_of s) ->
  all_explored n past seen -> explores rl n base walls s seen sent = Some seen' ->
  exists past' st, run n rl base (stands walls) past' st /\ all_explored n past' seen'.
Proof.
  intros rl n base walls sent; induction sent as [|number sent IH]; intros s seen past seen' R A E; cbn [explores] in E.
  - injection E as <-; eauto.
  - destruct (replayed _ _ _ _ _ _) as [t|] eqn:X; [|discriminate]. cbn [replayed] in X.
    destruct (decoded _) as [l|]; [|discriminate]. destruct (team_move_of l) as [m|]; [|discriminate].
    destruct (next n rl base walls s m) as [u|] eqn:Y; [|discriminate].
    destruct (says_so n walls s l); [|discriminate]. injection X as <-.
    eapply IH; [eapply next_run; eauto | | exact E]. now apply cells_explored.
Qed.

Definition is_end (rl : rule) (r : run_of_kernel) : bool :=
  let '(n, base, walls, sent, _) := r in
  match explores rl n base walls (list_start n base) [base] sent,
    hears n (begins n base) (map (bytes (pred n)) sent) with
  | Some seen, Some k => forallb (is_in seen) (reached (map_of n base k) base (n - 1))
  | _, _ => false
  end.

Lemma all_end : forallb (fun rs => forallb (is_end (fst rs)) (snd rs)) runs_of_kernel = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem kernel_runs_end : forall rl rs n base walls sent last, In (rl, rs) runs_of_kernel ->
  In (n, base, walls, sent, last) rs -> 1 <= n ->
  exists k past st, hears n (begins n base) (map (bytes (pred n)) sent) = Some k
    /\ run n rl base (stands walls) past st /\ ends n base (map_of n base k) past.
Proof.
  intros rl rs n base walls sent last I J L. pose proof all_end as A.
  rewrite forallb_forall in A; specialize (A _ I); cbn [fst snd] in A. rewrite forallb_forall in A; specialize (A _ J).
  unfold is_end in A. destruct (explores _ _ _ _ _ _ _) as [seen|] eqn:E; [|discriminate].
  destruct (hears _ _ _) as [k|]; [|discriminate].
  destruct (explores_run rl n base walls sent (list_start n base) [base] [pos (state_of (list_start n base))] seen)
    as [past [st [R X]]]; auto.
  - apply run_start, alike_start.
  - intros c [<-|[]]; exists (pos (state_of (list_start n base))), 0. split; [now left|]. split; [lia|].
    cbn; unfold team_of. destruct n; [lia | reflexivity].
  - exists k, past, st; repeat split; auto. intros c C. rewrite forallb_forall in A. apply X, is_in_spec; auto.
Qed.
