(** CHAIN-1: after every team move each robot is in E_C of its neighbours in the chain.

    For every number of robots, every layout, every order of preference and every choice of when to take a move
    back. The pair lemma is what proofs/src/chain/pair.rs checks case by case; here it needs no case but four,
    since E_S is a subset of E_C and E_C is symmetric. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team.
Import ListNotations.

(** One pair of neighbours in one team move. [arr] and [arr'] are where the two end: where they planned to be or
    where they were; a robot that is sure to arrive is where it planned to be. *)
Lemma pair_contact : forall r own ahead arr arr',
  safe_ahead r = true -> covered_behind r = true -> unsure_ahead r = true ->
  covers COVERED (from own) (from ahead) = true ->
  admits_ahead r own ahead = true ->
  (to ahead = from ahead \/ admits_behind r (to ahead) (from own) = true) ->
  (arr = to own \/ arr = from own) -> (arr' = to ahead \/ arr' = from ahead) ->
  (is_sure ahead = true -> arr' = to ahead) ->
  covers COVERED arr arr' = true.
Proof.
  intros r own ahead arr arr' Hs Hc Hu C A B E E' K.
  unfold admits_ahead, admits_behind in *; rewrite Hs, Hc, Hu in *; cbn in *.
  apply andb_true_iff in A; destruct A as [S U].
  assert (covers COVERED (to own) (to ahead) = true) as T
    by (rewrite covers_sym; eapply covers_mono; [|exact S]; unfold SAFE, COVERED; lia).
  destruct E as [-> | ->], E' as [-> | ->]; auto.
  - destruct (is_sure ahead) eqn:Q; [rewrite K; auto|].
    rewrite orb_true_r in U; cbn in U; now rewrite covers_sym.
  - destruct B as [-> | B]; auto.
Qed.

Section Contact.
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable wall : edge -> bool.

  Definition contact (p : team) : Prop := forall i, S i < N -> covers COVERED (p i) (p (S i)) = true.

  Lemma admitted_ahead : forall st pl i, admitted N rl base st pl = true -> S i < N ->
    admits_ahead rl (as_move st pl i) (as_move st pl (S i)) = true.
  Proof.
    intros st pl i A L; unfold admitted in A; rewrite !andb_true_iff in A.
    destruct A as [[[_ A] _] _]; rewrite every_spec in A; apply A; lia.
  Qed.

  Lemma admitted_robot : forall st pl i, admitted N rl base st pl = true -> S i < N ->
    admits_robot N rl base st pl (S i) = true.
  Proof.
    intros st pl i A L; unfold admitted in A; rewrite !andb_true_iff in A.
    destruct A as [[_ A] _]; rewrite every_spec in A; apply A; lia.
  Qed.

  Lemma admitted_behind : forall st pl i, admitted N rl base st pl = true -> S i < N ->
    planned st pl (S i) = pos st (S i) \/ admits_behind rl (planned st pl (S i)) (pos st i) = true.
  Proof.
    intros st pl i A L; pose proof (admitted_robot _ _ _ A L) as R; unfold admits_robot in R.
    apply andb_true_iff in R; destruct R as [R _]; apply orb_true_iff in R; destruct R as [R|R]; [left|auto].
    apply andb_true_iff in R; destruct R as [_ R]. unfold stays in R; unfold planned, to, as_move; cbn.
    now destruct (pl (S i)).
  Qed.

  Lemma moved_or_not : forall st pl i,
    moved wall (pos st) pl i = planned st pl i \/ moved wall (pos st) pl i = pos st i.
  Proof. intros st pl i; unfold moved, made; destruct arrives; auto. Qed.

  Lemma sure_arrives : forall st pl i, sound wall st -> is_sure (as_move st pl i) = true ->
    moved wall (pos st) pl i = planned st pl i.
  Proof.
    intros st pl i K Q; unfold moved, made, planned, to, as_move, is_sure in *; cbn in *.
    destruct (pl i) as [s|]; cbn; [|reflexivity]. apply K in Q; now rewrite Q.
  Qed.

  Hypothesis two_robots : 2 <= N.
  Hypothesis has_safe_ahead : safe_ahead rl = true.
  Hypothesis has_covered_behind : covered_behind rl = true.
  Hypothesis has_unsure_ahead : unsure_ahead rl = true.

  Theorem contact_always : forall st, reachable N rl base wall st -> contact (pos st).
  Proof.
    intros st [past R].
    destruct (composition N rl base wall contact (fun _ _ => True)) with (past := past) (st := st)
      as [_ [E _]]; auto; try lia.
    - intros p q S C i L; rewrite <- !S by lia; auto.
    - intros i _; apply covers_self; unfold COVERED; lia.
    - intros s pl K _ C A; split; [|exact I]; intros i L.
      apply pair_contact with (r := rl) (own := as_move s pl i) (ahead := as_move s pl (S i)); auto.
      + now apply C.
      + now apply admitted_ahead.
      + now apply admitted_behind.
      + apply moved_or_not.
      + apply moved_or_not.
      + now apply sure_arrives.
    - apply explains_inv in E; apply E.
  Qed.
End Contact.

(** After every team move each robot is in E_C of its neighbours in the chain. *)
Theorem CHAIN_1 : forall N base wall st, 2 <= N -> reachable N REPAIRED base wall st ->
  forall i, S i < N -> covers COVERED (pos st i) (pos st (S i)) = true /\
    covers COVERED (pos st (S i)) (pos st i) = true.
Proof.
  intros N base wall st L R i Li.
  assert (covers COVERED (pos st i) (pos st (S i)) = true) as C
    by (eapply contact_always; eauto; reflexivity).
  split; [exact C | now rewrite covers_sym].
Qed.
