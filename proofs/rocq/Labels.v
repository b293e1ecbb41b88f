(** The labels of trees: BRICKS-14, for every number of agents and of trees that have labels, and how the kernel's labels
    agree. *)
From Coq Require Import NArith Lia Bool List.
From Tautline.generated Require Import TreesAnswers.
Import ListNotations.
Local Open Scope N_scope.

(** How many trees an agent can found, and how many agents there are at most. *)
Definition trees : N := 16777216.
Definition ids : N := 256.
(** So many of the lowest bits of the label of the tree that the agent [id] founds after so many others. *)
Definition label (bits founded id : N) : N := ((trees - 1 - founded) * ids + id) mod 2 ^ bits.

(** Two trees have different labels, and the one before which its agent had founded fewer has the greater. *)
Theorem BRICKS_14 : forall f i g j, f < trees -> g < trees -> i < ids -> j < ids -> (f, i) <> (g, j) ->
  label 32 f i <> label 32 g j /\ (f < g -> label 32 g j < label 32 f i).
Proof.
  intros f i g j F G I J N; unfold label, trees, ids in *. change (2 ^ 32) with 4294967296.
  rewrite !N.mod_small by lia. split; [|lia]. intros E. apply N. assert (f = g) as -> by lia.
  f_equal; lia.
Qed.

Theorem too_few_bits_break_BRICKS_14 : label 8 0 0 = label 8 1 0.
Proof. reflexivity. Qed.

Definition agrees (bits : N) (answers : list (N * N * N)) : bool :=
  forallb (fun a => let '(founded, id, said) := a in label bits founded id =? said) answers.
Theorem label_answers_agree : agrees 32 labels_32 = true /\ agrees 8 labels_8 = true /\ agrees 8 labels_32 = false.
Proof. repeat split; vm_compute; reflexivity. Qed.
