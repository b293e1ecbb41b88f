(** FRONTIER-13: no robot enters what it has claimed if a robot was there before, or is on its way there. For every number
    of robots, every finite graph of cells, every set of obstacles and every order, as long as no message is missed. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Explorers ExplorersEnd.
Import ListNotations.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool).
  Variable N : nat.
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_cells : forall u v, In v (beside u) -> In v cells.
  Variable rl : rule V.
  Notation leads := (leads V same obstacle N rl).

  (** A run of which every message is heard. *)
  Inductive heard_run : world V -> Prop :=
  | heard_start : forall start w, may_start V cells obstacle N start -> alike V N (begins V N start) w -> heard_run w
  | heard_step : forall w e w', heard_run w -> missed V e = false -> leads w e w' -> heard_run w'.

  (** What was entered is on every map. *)
  Lemma all_know : forall w, heard_run w -> forall i v, i < N -> In v (been w) -> In v (explored (robots w i)).
  Proof.
    intros w R; induction R as [start w _ [A [B _]] | w e w' _ IH H St]; intros i v I J.
    { rewrite <- A by exact I; now rewrite <- B in J. }
    assert (In v (been w) -> In v (explored (robots w' i))) as Old.
    { intros K; destruct (step_longer V same obstacle N rl _ _ _ St i I) as [x [y [-> _]]].
      apply in_or_app; left; now apply IH. }
    destruct St as [x [E [A [B _]]]]; rewrite <- B in J.
    destruct e as [j u c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _); [|discriminate]; injection E as <-; auto.
    - destruct (doing (robots w j)); try discriminate. destruct (negb _); [discriminate|].
      destruct (meets _ _ _ _ _ _); injection E as <-; rewrite (proj2 (settle_robots _ _ _ _)) in J; auto.
    - destruct (doing (robots w j)) as [|u|u]; try discriminate. destruct (j <? N); [|discriminate].
      cbn in H; destruct ms; [|discriminate]; injection E as <-; rewrite (proj2 (settle_robots _ _ _ _)) in J.
      destruct J as [<-|J]; [|now apply Old]. rewrite <- A by exact I; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots].
      unfold tells, put; destruct (i =? j) eqn:D; cbn; apply (in_join V same cells beside same_spec beside_cells).
      + right; now left.
      + right; rewrite Nat.eqb_refl; apply (in_join V same cells beside same_spec beside_cells); right; now left.
    - destruct (may_tick _ _ _ _); [|discriminate]; injection E as <-; auto.
  Qed.

  Theorem FRONTIER_13 : forall w i ms un sl w' v, returns rl = true -> heard_run w -> leads w (Looks i ms un sl) w' ->
    i < N -> doing (robots w' i) = Enters v -> aim (robots w' i) = Some v ->
    ~ In v (been w) /\ forall j, j < N -> j <> i -> doing (robots w j) <> Enters v.
  Proof.
    intros w i ms un sl w' v Rt R St I D Ai.
    pose proof (step_aim V same cells beside obstacle N same_spec beside_cells rl _ _ _ St i I) as A.
    destruct (step_self V same obstacle N same_spec rl _ _ _ St i I) as [[X _]|[X O]]; rewrite X in A;
      [cbn in X; now rewrite Nat.eqb_refl in X|].
    destruct O as [_ [u [T O]]]; specialize (A u T); unfold self in O.
    destruct O as [[Me O]|[Me O]]; [|injection O as _ O _; congruence].
    destruct A as [[A _]|[[_ [Ob _]]|[_ [Ob A]]]]; [congruence | rewrite Ob in O; injection O as _ O _; congruence|].
    rewrite Ob in O; cbn [orb] in O; destruct (late V same rl (robots w i) u) eqn:La; [injection O as _ O _; congruence|].
    injection O as _ O _; rewrite D in O; injection O as <-. split.
    - intros B; apply (all_know w R i v I) in B; apply (has_in V same cells beside same_spec beside_cells) in B.
      unfold late in La; rewrite Rt, B, <- A, Ai in La; cbn in La; now rewrite (proj2 (same_spec v v) eq_refl) in La.
    - intros j J Ne E; assert (In j (meets V same N w i v)) as M; [|now rewrite Me in M].
      apply filter_In; split; [apply in_seq; lia|]. apply Nat.eqb_neq in Ne; rewrite Ne, E; cbn.
      rewrite (proj2 (same_spec v v) eq_refl); apply orb_true_r.
  Qed.
End Area.
