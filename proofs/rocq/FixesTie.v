(** The tie between the kernel and Fixes.v: which cell a fix is taken for in a row of three cells, and what it tells a robot
    that counts itself to be in the second one, is what the kernel answers in generated/FixAnswers.v. *)
From Coq Require Import ZArith List.
From Tautline Require Import Fixes.
From Tautline.generated Require Import FixAnswers.
Import ListNotations.
Local Open Scope Z_scope.

(** From a cell before the row to one behind it. *)
Definition fixes : list Z := map (fun i => Z.of_nat i - 3 * half) (seq 0 (Z.to_nat (4 * half + 2 * half * (last + 1) + 1))).

Theorem fix_answers_agree : map (taken_for half 0 last) fixes = taken /\ map (clamped half 1) fixes = told
  /\ map (taken_for half 0 last) fixes <> map (fun fix_ => taken_for half 0 last (fix_ + 1)) fixes.
Proof. repeat split; vm_compute; try reflexivity; discriminate. Qed.
