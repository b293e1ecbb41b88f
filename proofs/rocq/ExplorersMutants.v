(** The condition Route is needed for FRONTIER-1: a robot that looks at the cells beside its own alone, as published, ends
    with a cell left. *)
From Coq Require Import Bool List Arith.
From Tautline Require Import Explorers ExplorersTie.
Import ListNotations.

Definition beside_alone : rule nat :=
  {| chooses := fun _ r => map (fun v => (v, v))
       (filter (fun v => negb (has nat Nat.eqb (explored r) v) && negb (has nat Nat.eqb (blocked r) v)) (beside 3 1 (place r)));
     claims := false |}.

(** Three cells in a row, and the robot begins in the middle: it goes west. *)
Definition story_ : story := [([(0, 0); (0, 2)], false, Decides 0 0 0 []); ([], false, Looks 0 [] [] 0); ([], false, Arrives 0 [])].

Theorem without_Route_breaks_FRONTIER_1 : exists w, run nat Nat.eqb (cells 3 1) (obstacle []) 1 beside_alone w
  /\ ended nat Nat.eqb (obstacle []) 1 beside_alone w
  /\ joined nat (beside 3 1) (obstacle []) (place (robots w 0)) 2 /\ ~ In 2 (been w).
Proof.
  destruct (replay [] 1 beside_alone (begins_in 1 [1]) story_) as [w|] eqn:E; [|vm_compute in E; discriminate].
  exists w; split; [eapply replay_runs; [apply (begins_runs 3 1 [] 1 beside_alone [1]); reflexivity | exact E]|].
  assert (is_over 1 beside_alone w && (place (robots w 0) =? 0) && negb (existsb (Nat.eqb 2) (been w)) = true) as H
    by (vm_compute in E; injection E as <-; vm_compute; reflexivity).
  rewrite !andb_true_iff, negb_true_iff, Nat.eqb_eq in H; destruct H as [[O P] B].
  split; [eapply over_ended; exact O|]; split.
  - rewrite P; apply joined_over with (v := 1); [apply joined_over with (v := 0); [apply joined_self | cbn; auto | reflexivity] | cbn; auto | reflexivity].
  - intros I; apply not_true_iff_false in B; apply B; apply existsb_exists; exists 2; auto.
Qed.
