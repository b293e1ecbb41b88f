(** The tie between the kernel and Homing.v: whatever the kernel's robots have done in generated/HomingAnswers.v is in
    [outcomes].

    The table has every state that signals of three nodes, with one hop and two, and one of another tree lead a robot
    to, from one to three hops away, whatever is measured; a scan is one measurement. *)
From Coq Require Import List Bool Arith.
From Tautline Require Import Mrc MrcTie Homing.
From Tautline.generated Require Import HomingAnswers.
Import ListNotations.

Definition eq_homing (x y : homing) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.

(** A robot that goes to WFR [goal]. It sends nothing but what it asks. *)
Definition homing_agrees (goal : nat) : bool :=
  agrees homing input eq_homing (fun x i => map (fun y => (y, [])) (outcomes goal x i)) homing_states homing_inputs
    homing_says homing_answers.

Theorem homing_answers_agree : homing_agrees 0 = true /\ homing_agrees 9 = false
  /\ (100 <=? changes homing_answers) = true.
Proof. repeat split; vm_compute; reflexivity. Qed.

Definition eq_conduct (x y : conduct) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.

(** What the kernel's node [me] that guides has done, in every conduct, [guide_step] does. *)
Definition guides_agree (me : nat) : bool :=
  forallb (fun '(x, i, y) => if eq_conduct (guide_step me x i) y then true else false) guides.

Theorem guide_answers_agree : guides_agree 1 = true /\ guides_agree 2 = false.
Proof. split; vm_compute; reflexivity. Qed.
