(** The tie between the kernel and Patience.v: what the kernel's robots have done in generated/PatienceRuns.v, [step] does. *)
From Coq Require Import ZArith List Bool Arith.
From Tautline Require Import Patience.
From Tautline.generated Require Import PatienceRuns.
Import ListNotations.

Definition eq_order (x y : order) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.

(** After each group of inputs the robot does what the kernel's does, as far from its WFR. *)
Fixpoint agrees (next : robot -> input -> robot) (x : robot) (steps : list (list input * order * nat)) : bool :=
  match steps with
  | [] => true
  | (is_, o, h) :: steps => let x := fold_left next is_ x in
      (if eq_order (ordered x) o then true else false) && (hops x =? h) && agrees next x steps
  end.
Definition run_agrees (more_tries more_times : nat) (r : nat * nat * list (list input * order * nat)) : bool :=
  let '(tries, times, steps) := r in let (t, s) := (more_tries + tries, more_times + times) in
  agrees (step 0 near closer s t turns) (sets_out s t 2 3) steps.

Theorem kernel_walks_agree : forallb (run_agrees 0 0) walks = true
  /\ forallb (run_agrees 1 0) walks = false /\ forallb (run_agrees 0 1) walks = false.
Proof. repeat split; vm_compute; reflexivity. Qed.
