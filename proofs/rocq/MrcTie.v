(** The tie between the kernel and Mrc.v: whatever the kernel's robots and WFRs have done in
    generated/MrcAnswers.v, repaired, is in the lists of outcomes that Leases.v speaks of.

    The table has every state of a robot with room for one record and for two that two epochs of two WFRs lead
    to, and every state of a WFR with two robots up to its second call. *)
From Coq Require Import List Bool Arith.
From Tautline Require Import Mrc.
From Tautline.generated Require Import MrcAnswers.
Import ListNotations.

Definition eq_robot (x y : robot) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition eq_wfr (x y : wfr) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition eq_messages (x y : list message) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.

Section Table.
  Variables (state input : Type).
  Variable eq_state : forall x y : state, {x = y} + {x <> y}.
  Variable outcomes : state -> input -> list (state * list message).
  Variables (states : list state) (inputs : list input) (says : list (list message)).

  Definition is_outcome (x : state) (i : input) (y : state) (out : list message) : bool :=
    existsb (fun o => (if eq_state y (fst o) then true else false) && (if eq_messages out (snd o) then true else false))
      (outcomes x i).

  (** An answer by its numbers: of the state that follows, and of what is sent. *)
  Definition is_known (x : state) (i : input) (a : nat * nat) : bool :=
    match nth_error states (fst a), nth_error says (snd a) with
    | Some y, Some out => is_outcome x i y out
    | _, _ => false
    end.

  (** Where no answer is listed, nothing changes and nothing is sent. *)
  Definition is_right (x : state) (i : input) (l : list (nat * nat)) : bool :=
    match l with [] => is_outcome x i x [] | _ => forallb (is_known x i) l end.

  Definition agrees (answers : list (list (list (nat * nat)))) : bool :=
    (length answers <=? length states)
    && forallb (fun row => (length (snd row) =? length inputs)
         && forallb (fun cell => is_right (fst row) (fst cell) (snd cell)) (combine inputs (snd row)))
         (combine states answers).

  (** How many answers change something: a table without them would show nothing. *)
  Definition changes (answers : list (list (list (nat * nat)))) : nat := length (concat (concat answers)).
End Table.

Definition robots_agree (rl : rule) : bool :=
  agrees robot robot_input eq_robot (robot_outcomes rl 1) robot_states robot_inputs robot_says robot_answers.
Definition wfrs_agree (rl : rule) : bool :=
  agrees wfr wfr_input eq_wfr (wfr_outcomes rl 1) wfr_states wfr_inputs wfr_says wfr_answers.

(** Every answer in the table is among the outcomes; by the other rules not every one is, so that the table
    tells rules apart. *)
Theorem mrc_answers_agree :
  robots_agree REPAIRED = true /\ wfrs_agree REPAIRED = true
  /\ wfrs_agree without_ChoiceStands = false
  /\ robots_agree without_Epochs = false /\ wfrs_agree without_Epochs = false
  /\ robots_agree without_Consent = false /\ wfrs_agree without_Consent = false
  /\ (100 <=? changes robot_answers) = true /\ (100 <=? changes wfr_answers) = true.
Proof. repeat split; vm_compute; reflexivity. Qed.
