(** The tie between the kernel and Fused.v: what a kernel's belief becomes by a fix of which a half, a quarter or another share
    counts, and how far it drives then, is what the definitions say, in generated/FixAnswers.v. *)
From Coq Require Import ZArith QArith List Bool.
From Tautline Require Import Fused.
From Tautline.generated Require Import FixAnswers.
Import ListNotations.
Local Open Scope Q_scope.

(** Of a fix one part in [q] counts; lengths are in 64ths of a cell's side. *)
Definition agrees (share : Z -> Q) (x : Z * Z * Z * Z * Z) : bool :=
  let '(q, believed, fix_, after, way) := x in
  Qeq_bool (corrected (share q) (believed # 64) (fix_ # 64)) (after # 64)
  && Qeq_bool (inject_Z 2 - (after # 64)) (way # 64).

Theorem fused_answers_agree : forallb (agrees (fun q => / inject_Z q)) fused = true
  /\ forallb (agrees (fun _ => 1)) fused = false.
Proof. split; vm_compute; reflexivity. Qed.
