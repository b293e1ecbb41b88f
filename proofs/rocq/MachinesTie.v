(** The tie between the kernel and Machines.v: whatever the kernel's robots and WFRs have done in
    generated/MachineAnswers.v, the functions do, too, and nothing else.

    The tables have every state of a repaired robot with room for one record and for two, and of a published one,
    that a call of one WFR and two of another lead to, from two distances; every state of a WFR with room for one
    robot and for two, and of one that repeats twice, up to its third call; and what a path node with room for one way
      and for four answers after
    any three of 13 messages. *)
From Coq Require Import ZArith NArith List Bool Arith.
From Tautline Require Import Machines.
From Tautline.generated Require Import MachineAnswers.
Import ListNotations.

Section Table.
  Variables (state input out : Type).
  Variable eq_state : forall x y : state, {x = y} + {x <> y}.
  Variable eq_out : forall x y : out, {x = y} + {x <> y}.
  Variable step : state -> input -> state * out.
  Variable silence : out.
  Variables (states : list state) (inputs : list input) (says : list out).

  (** It comes to that state and sends that. *)
  Definition does (x : state) (i : input) (y : option state) (o : option out) : bool :=
    match y, o, step x i with
    | Some y, Some o, (z, q) => (if eq_state y z then true else false) && (if eq_out o q then true else false)
    | _, _, _ => false
    end.

  (** The answers to the inputs from number [k] on. To an input that has none, the state stays and is silent. *)
  Fixpoint answers_right (x : state) (k : N) (l : list input) (row : list (N * N * N)) : bool :=
    match l with
    | [] => match row with [] => true | _ => false end
    | i :: l =>
        match row with
        | (j, s, o) :: more =>
            if N.eqb j k then
              does x i (nth_error states (N.to_nat s)) (nth_error says (N.to_nat o)) && answers_right x (N.succ k) l
                more
            else does x i (Some x) (Some silence) && answers_right x (N.succ k) l row
        | [] => does x i (Some x) (Some silence) && answers_right x (N.succ k) l []
        end
    end.

  (** States beyond the bound have no answers. *)
  Definition agrees (answers : list (option (list (N * N * N)))) : bool :=
    (length states =? length answers)
    && forallb (fun row => match snd row with Some l => answers_right (fst row) 0 inputs l | None => true end)
         (combine states answers).
End Table.

Definition eq_robot (x y : robot) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition eq_said (x y : option upward) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition eq_wfr (x y : wfr) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition eq_mail (x y : list mail) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.

Definition robots_agree (rl : rule) (room : nat) := agrees robot robot_input _ eq_robot eq_said (robot_step rl 1 room)
  None.
Definition wfrs_agree (rl : rule) (room : nat) := agrees wfr wfr_input _ eq_wfr eq_mail (wfr_step rl 1 room) [].

Definition robots_2_agree (rl : rule) : bool := robots_agree rl 2 robot_2_states robot_2_inputs robot_2_says
  robot_2_answers.
Definition wfrs_2_agree (rl : rule) : bool := wfrs_agree rl 2 wfr_2_states wfr_2_inputs wfr_2_says wfr_2_answers.

(** The tables tell the rules apart. *)
Theorem machine_answers_agree :
  robots_agree REPAIRED 1 robot_1_states robot_1_inputs robot_1_says robot_1_answers = true
  /\ robots_2_agree REPAIRED = true
  /\ robots_agree PUBLISHED 2 published_states published_inputs published_says published_answers = true
  /\ wfrs_agree REPAIRED 1 wfr_1_states wfr_1_inputs wfr_1_says wfr_1_answers = true
  /\ wfrs_2_agree REPAIRED = true
  /\ robots_agree (repeating 2) 2 robot_full_states robot_full_inputs robot_full_says robot_full_answers = true
  /\ wfrs_agree (repeating 2) 1 wfr_patient_states wfr_patient_inputs wfr_patient_says wfr_patient_answers = true
  /\ robots_agree REPAIRED 2 robot_full_states robot_full_inputs robot_full_says robot_full_answers = false
  /\ wfrs_agree REPAIRED 1 wfr_patient_states wfr_patient_inputs wfr_patient_says wfr_patient_answers = false
  /\ existsb robots_2_agree [PUBLISHED; without_NearestCall; without_LeastIdentity; without_Epochs;
    without_Repetition] = false
  /\ existsb wfrs_2_agree [without_NearestRobot; without_LeastIdentity; without_ChoiceStands; without_AnswersAgain;
       without_Epochs] = false.
Proof.
  do 7 (split; [vm_cast_no_check (eq_refl true)|]).
  do 3 (split; [vm_cast_no_check (eq_refl false)|]). vm_cast_no_check (eq_refl false).
Qed.

(** Who gets each RESB after each three messages, as the kernel's path node has it: a digit each, the first the
    lowest. *)
Definition digit (r : nat) (h : option hop) : N :=
  match h with
  | None => 0
  | Some (Robot q) => if q =? r then 1 else 3
  | Some (Node n) => if n =? 5 then 2 else 3
  end.

Definition resbs : list (nat * nat * nat) :=
  flat_map (fun r => map (fun c => (fst c, snd c, r)) [(1, 1); (1, 2); (2, 1)]) [1; 2].

Definition ways_code (room : nat) (l : list passing) : N :=
  fold_right (fun '(w, e, r) sum => (3 * sum + digit r (goes_to (after (relay_step 7 room) [] l) w e r))%N) 0%N resbs.

Definition all_ways (room : nat) : list N :=
  flat_map (fun a => flat_map (fun b => map (fun c => ways_code room [a; b; c]) passings) passings) passings.

Theorem ways_agree : all_ways 1 = ways_1 /\ all_ways 4 = ways_4 /\ ways_1 <> ways_4.
Proof.
  split; [vm_cast_no_check (eq_refl ways_1)|]. split; [vm_cast_no_check (eq_refl ways_4)|]. vm_compute; congruence.
Qed.
