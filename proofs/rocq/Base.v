(** CHAIN-6: the base never moves, under every rule. That it never plans to is part of the admission relation.

    And: a backtrack meets no wall, so that the kernel need not ask. *)
From Coq Require Import List Arith Lia Bool.
From Tautline Require Import Lattice Rule Team.
Import ListNotations.

Section Base.
  Variables (N : nat) (rl : rule) (base : cell) (wall : edge -> bool).
  Hypothesis one_robot : 1 <= N.

  Lemma base_stays : forall past st, run N rl base wall past st -> Forall (fun p => p 0 = base) past.
  Proof.
    intros past st R.
    destruct (composition N rl base wall (fun _ => True) (fun _ _ => True)) with (past := past) (st := st)
      as [_ [_ [_ [_ F]]]]; auto.
    eapply Forall_impl; [|exact F]. intros p [B _]; exact B.
  Qed.

  Lemma backtrack_meets_none : forall st pl rest, reachable N rl base wall st -> log st = pl :: rest ->
    forall i, i < N -> arrives wall (pos st i) (undo pl i) = true.
  Proof.
    intros st pl rest [past R] G.
    eapply (backtrack_arrives N rl base wall (fun _ => True) (fun _ _ => True)); eauto.
  Qed.
End Base.

(** The base never plans to move, and never moves. *)
Theorem CHAIN_6 : forall N rl base wall past st, 1 <= N -> run N rl base wall past st ->
  Forall (fun p => p 0 = base) past /\ forall pl, admitted N rl base st pl = true -> pl 0 = Stay.
Proof.
  intros N rl base wall past st L R; split; [eapply base_stays; eauto|].
  intros pl A; unfold admitted in A; rewrite !andb_true_iff in A; destruct A as [[[A _] _] _].
  unfold stays in A; now destruct (pl 0).
Qed.

Theorem backtrack_meets_no_wall : forall N rl base wall st pl rest,
  1 <= N -> reachable N rl base wall st -> log st = pl :: rest ->
  forall i, i < N -> arrives wall (pos st i) (undo pl i) = true.
Proof. intros; eapply backtrack_meets_none; eauto. Qed.
