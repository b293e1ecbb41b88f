(** The tie between the kernel's pass over the plan of a whole team, [Rule::admits_plan], and Admission.v: its answers
    in generated/PlanAnswers.v by three rules, of plans on drawn maps. No rule with a condition fewer gives these
    answers. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Message Replay Admission.
From Tautline.generated Require Import PlanAnswers.
Import ListNotations.

Definition asked : Type := nat * list cell * list edge * list edge * list N * list N.

Definition steps_in (n : nat) (number : N) : list step :=
  Stay :: map (fun place => nth (N.to_nat place) all_steps Stay) (bytes (pred n) number).

(** What Admission.v answers by this rule, a bit for each plan. *)
Definition answers (rl : rule) (a : asked) : N :=
  let '(n, cells, walls, open, plans, _) := a in
  let st := state_of {| places := cells; opened := open; made_so_far := [] |} in
  let accepts number := admits_plan n rl (nth 0 cells (0, 0)%Z) (has walls) st (plan_of (steps_in n number)) in
  fold_right (fun number bits => N.add (N.double bits) (if accepts number then 1 else 0)%N) 0%N plans.

Definition agrees (rl : rule) (k : nat) : bool :=
  forallb (fun a => let '(_, _, _, _, _, told) := a in N.eqb (answers rl a) (nth k told 0%N)) accepted.

Theorem plans_are_accepted :
  agrees PUBLISHED 0 && agrees REPAIRED 1 && agrees REEL 2 = true
  /\ existsb (fun rl => agrees rl 1) [PUBLISHED; REEL; without_SafeAhead; without_CoveredBehind; without_Distinct;
       without_UnsureAhead; without_FullForFollower; without_FullForLeader] = false.
Proof. split; vm_compute; reflexivity. Qed.
