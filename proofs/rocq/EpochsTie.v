(** The tie between the kernel's planner by epochs and Epochs.v: runs as published and repaired.

    A run is given by its walls and, of each team move, by the bytes that the robots sent, whether an epoch begins with
    it, the virtual obstacles that its plan puts, and all team moves of an unfolding that it begins. Each must be a team
    move of Epochs.v. The distance is that over the map, known walls and virtual obstacles avoided. What is refused
    just before an epoch ends is not seen: the leader's sides without a virtual obstacle are taken for it. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Message Replay Heard Reach Replayed Reel Scripts Epochs.
From Tautline Require ReelTie.
From Tautline.generated Require Import EpochRuns.
Import ListNotations.

(** The cells beside those of a [ring], by the map. *)
Definition beside (m : chart) (v : list edge) (c : cell) : list cell :=
  flat_map (fun s => let e := edge_of c s in if has (met m) e then [] else if has v e then [] else [beyond c s])
    all_sides.
Fixpoint nearest (fuel : nat) (m : chart) (v : list edge) (ring visited : list cell) (n : nat) : option nat :=
  if explores m ring then Some n
  else match fuel with
    | O => None
    | S fuel =>
        let '(next, visited) := fold_left (fun '(next, visited) c =>
          if is_in visited c then (next, visited) else (c :: next, c :: visited)) (flat_map (beside m v) ring) ([],
            visited) in
        match next with [] => None | _ :: _ => nearest fuel m v next visited (S n) end
    end.
Definition distance (m : chart) (v : list edge) (c : cell) : option nat := nearest 100 m v [c] [c] 0.

Definition told : Type := N * bool * list edge * list N.
Definition run_of_kernel : Type := nat * cell * list edge * list edge * list told * list cell.

Section Kernel.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge) (may_unfold : bool).

  Notation plans := (plans N rl base true may_unfold distance).
  Notation moves := (moves N rl base walls true may_unfold distance).

  Definition is_nearer (a b : option nat) : bool :=
    match a, b with Some a, Some b => a <? b | Some _, None => true | None, _ => false end.
  Definition are_refused (v : list edge) (p : list cell) (new : list edge) : bool :=
    forallb (fun e => negb (has v e) && existsb (fun s => edge_eqb e (edge_of (leader_of N p) s)) all_sides) new.
  Definition is_led (m : chart) (open v : list edge) (p : list cell) (new : list edge) (pl : list step) : bool :=
    are_refused v p new && admits N rl base open p pl && Reel.is_free N m p pl
    && match new with
       | [] => is_nearer (distance m v (after (leader_of N p) (nth (pred N) pl Stay))) (distance m v (leader_of N p))
       | _ :: _ => true
       end.
  Definition is_stuck (m : chart) (v : list edge) (p : list cell) (new : list edge) : bool :=
    are_refused v p new
    && match new with [] => match distance m v (leader_of N p) with None => true | Some _ => false end
      | _ :: _ => true end.
  (** The leader's sides without a virtual obstacle, if there is a way on. *)
  Definition unseen_refusals (m : chart) (v : list edge) (p : list cell) : list edge :=
    match distance m v (leader_of N p) with
    | None => []
    | Some _ => filter (fun e => negb (has v e)) (map (edge_of (leader_of N p)) all_sides)
    end.

  Definition planned_by (x : chain) (e : told) : option (team_move * list edge * stage) :=
    let '(number, begins, new, script) := e in
    let '(m, open, v, p) := (chart_of x, opened (team_at x), virtual x, places (team_at x)) in
    match option_map team_move_of (decoded (bytes (pred N) number)) with
    | Some (Some (Advance pl)) =>
        if begins then
          if is_stuck m v p (unseen_refusals m v p) && match made_so_far (team_at x) with [] => true
            | _ :: _ => false end then
            match script, stage_of x, ReelTie.script_of N script with
            | [], Gained, _ => if is_led m open [] p new pl then Some (Advance pl, new, Seeking) else None
            | _ :: _, Gained, Some t | _ :: _, Seeking, Some t =>
                if may_unfold && explores_in N Scripts.script (Scripts.follows N rl base) (length t) m open t p then
                  match Scripts.follows N rl base m open t p with
                  | Some (pl, more) => Some (Advance pl, [], Unfolding more)
                  | None => None
                  end
                else None
            | _, _, _ => None
            end
          else None
        else
          match stage_of x with
          | Unfolding t =>
              match Scripts.follows N rl base m open t p with
              | Some (pl, more) => Some (Advance pl, v, Unfolding more)
              | None => None
              end
          | Gained | Seeking => if is_led m open v p new pl then Some (Advance pl, new ++ v, stage_of x) else None
          end
    | Some (Some (Backtrack _)) =>
        match stage_of x, made_so_far (team_at x) with
        | Unfolding _, _ | _, [] => None
        | Gained, pl :: _ | Seeking, pl :: _ => if is_stuck m v p new then Some (back N pl, new ++ v,
          stage_of x) else None
        end
    | _ => None
    end.

  Lemma nearer_spec : forall a b, is_nearer a b = true -> nearer a b.
  Proof. intros [a|] [b|]; cbn; try discriminate; auto. apply Nat.ltb_lt. Qed.
  Lemma refused_spec : forall v p new, are_refused v p new = true -> refuses N v p new.
  Proof.
    intros v p new R e I; unfold are_refused in R; rewrite forallb_forall in R; specialize (R e I).
    apply andb_true_iff in R; destruct R as [R S]; apply existsb_exists in S; destruct S as [s [_ S]].
    split; [now apply negb_true_iff | exists s; now apply edge_eqb_spec].
  Qed.
  Lemma led_spec : forall m open v p new pl, is_led m open v p new pl = true ->
    leads N rl base distance m open v p new pl.
  Proof.
    intros m open v p new pl L; unfold is_led in L; rewrite !andb_true_iff in L; destruct L as [[[R A] F] D].
    split; [now apply refused_spec|]. split; [exact A|]. split; [exact F|]. intros ->; now apply nearer_spec.
  Qed.
  Lemma stuck_spec : forall m v p new, is_stuck m v p new = true -> fails N distance m v p new.
  Proof.
    intros m v p new F; unfold is_stuck in F; apply andb_true_iff in F; destruct F as [R D].
    split; [now apply refused_spec|]. intros ->; now destruct (distance _ _ _).
  Qed.

  Lemma planned_plans : forall x e mv v s, planned_by x e = Some (mv, v, s) -> plans x mv v s.
  Proof.
    intros x [[[number begins] new] script] mv v s E; unfold planned_by in E.
    destruct (option_map _ _) as [[[pl|back_]|]|]; try discriminate.
    - destruct begins.
      + destruct (_ && _) eqn:K in E; [|discriminate]. apply andb_true_iff in K; destruct K as [F H].
        apply stuck_spec in F. assert (made_so_far (team_at x) = []) as H' by (now destruct (made_so_far (team_at x))).
        assert (forall t, (stage_of x = Gained \/ stage_of x = Seeking) ->
          (if may_unfold && explores_in N Scripts.script (Scripts.follows N rl base) (length t) (chart_of x)
               (opened (team_at x)) t (places (team_at x))
           then match Scripts.follows N rl base (chart_of x) (opened (team_at x)) t (places (team_at x)) with
                | Some (pl, more) => Some (Advance pl, [], Unfolding more) | None => None end
           else None) = Some (mv, v, s) -> plans x mv v s) as U.
        { intros t S Y. destruct (_ && _) eqn:Z in Y; [|discriminate]. apply andb_true_iff in Z; destruct Z as [Z1 Z2].
          destruct (Scripts.follows _ _ _ _ _ _ _) as [[q more]|] eqn:Q; [|discriminate]; injection Y as <- <- <-.
          eapply plans_unfolding; eauto. }
        destruct script as [|one script], (stage_of x) eqn:S; try discriminate.
        * destruct (is_led _ _ _ _ _ _) eqn:L; [|discriminate]; injection E as <- <- <-.
          eapply plans_epoch; eauto. now apply led_spec.
        * destruct (ReelTie.script_of _ _) as [t|]; [|discriminate]. apply (U t); auto.
        * destruct (ReelTie.script_of _ _) as [t|]; [|discriminate]. apply (U t); auto.
      + destruct (stage_of x) as [| |t] eqn:S.
        * destruct (is_led _ _ _ _ _ _) eqn:L; [|discriminate]; injection E as <- <- <-. rewrite <- S.
          apply plans_lead; [now rewrite S | now apply led_spec].
        * destruct (is_led _ _ _ _ _ _) eqn:L; [|discriminate]; injection E as <- <- <-. rewrite <- S.
          apply plans_lead; [now rewrite S | now apply led_spec].
        * destruct (Scripts.follows _ _ _ _ _ _ _) as [[q more]|] eqn:Q; [|discriminate]; injection E as <- <- <-.
          eapply plans_on; eauto.
    - destruct (stage_of x) as [| |t] eqn:S, (made_so_far (team_at x)) as [|pl rest] eqn:H; try discriminate;
        (destruct (is_stuck _ _ _ _) eqn:F; [|discriminate]; injection E as <- <- <-; rewrite <- S;
         eapply plans_back; [now rewrite S | now apply stuck_spec | exact H]).
  Qed.

  (** Whether the robots say that of this team move. *)
  Definition is_told (x : chain) (mv : team_move) (e : told) : bool :=
    let '(number, _, _, _) := e in
    match decoded (bytes (pred N) number) with
    | Some l =>
        match team_move_of l with
        | Some mv' =>
            ReelTie.same_move mv mv' && match mv with Backtrack _ => true
              | Advance _ => says_so N walls (team_at x) l end
        | None => false
        end
    | None => false
    end.

  Inductive story : chain -> list told -> chain -> Prop :=
  | story_ends : forall x, story x [] x
  | story_goes : forall x mv v s y e l z, moves x mv v s y -> is_told x mv e = true -> story y l z ->
    story x (e :: l) z.

  Fixpoint told_all (x : chain) (l : list told) : option chain :=
    match l with
    | [] => Some x
    | e :: l =>
        match planned_by x e with
        | Some (mv, v, s) =>
            match next N rl base walls (team_at x) mv with
            | Some t =>
                if is_told x mv e then
                  told_all {| team_at := t; chart_of := learns N walls (chart_of x) (team_at x) t mv; virtual := v;
                    stage_of := if explores (chart_of x) (places t) || finds N walls (chart_of x) (team_at x) mv
                      then Gained else s |} l
                else None
            | None => None
            end
        | None => None
        end
    end.

  Lemma told_story : forall l x z, told_all x l = Some z -> story x l z.
  Proof.
    induction l as [|e l IH]; intros x z E; cbn [told_all] in E; [injection E as <-; constructor|].
    destruct (planned_by x e) as [[[mv v] s]|] eqn:P; [|discriminate]. destruct (next _ _ _ _ _ _) as [t|] eqn:X;
      [|discriminate].
    destruct (is_told x mv e) eqn:T; [|discriminate].
    econstructor; [apply moves_so; [eapply planned_plans; exact P | exact X] | exact T | now apply IH].
  Qed.
End Kernel.

Definition runs_of_kernel : list (rule * bool * list run_of_kernel) :=
  [(PUBLISHED, false, epochs_PUBLISHED); (REPAIRED, true, epochs_REPAIRED)].

Definition is_run (rl : rule) (may_unfold : bool) (r : run_of_kernel) : bool :=
  let '(n, base, inside, border, l, last) := r in
  match told_all n rl base (inside ++ border) may_unfold (begins n base border) l with
  | Some x => list_eqb cell_eqb (places (team_at x)) last
  | None => false
  end.

Lemma all_are_runs : forallb (fun rs => forallb (is_run (fst (fst rs)) (snd (fst rs))) (snd rs)) runs_of_kernel = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(** Every run of the kernel's planner is one of Epochs.v: it says the same, and ends where the kernel has the robots. *)
Theorem kernel_epochs_run : forall rl may_unfold rs n base inside border l last, In (rl, may_unfold,
  rs) runs_of_kernel ->
  In (n, base, inside, border, l, last) rs ->
  exists x, story n rl base (inside ++ border) may_unfold (begins n base border) l x /\ places (team_at x) = last.
Proof.
  intros rl u rs n base inside border l last I J; pose proof all_are_runs as A. rewrite forallb_forall in A;
    specialize (A _ I); cbn [fst snd] in A. rewrite forallb_forall in A; specialize (A _ J). unfold is_run in A.
  destruct (told_all _ _ _ _ _ _ _) as [x|] eqn:E; [|discriminate]. apply list_eqb_cells in A.
  exists x; split; [now apply told_story | exact A].
Qed.
