(** The conditions of the chain's admission relation: the functions of kernel/src/chain/rule.rs, one by one.

    A rule is a set of conditions. The three others that the kernel has (RefusedIsVirtual, EpochMustGain,
    Unfold) and the order of preference only choose among admitted plans; nothing here depends on them.
    ChainTie.v compares each function with the kernel's answers. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice.
Import ListNotations.

(** Which conditions are in force. *)
Record rule := {
  (** P'_i is in E_S of P'_{i+1}. *)
  safe_ahead : bool;
  (** P'_i is in E_C of P_{i-1}. *)
  covered_behind : bool;
  (** No two robots plan to be in one cell, the base excepted. *)
  distinct : bool;
  (** Unless the robot ahead is sure to arrive, P'_i is also in E_C of P_{i+1}. *)
  unsure_ahead : bool;
  (** No follower enters a cell that two others occupy now, the base excepted; nor does the leader. *)
  full_for_follower : bool;
  full_for_leader : bool;
  (** P'_i is in E_C of P_{i+1} also where the robot ahead is sure to arrive. *)
  hold : bool;
}.

Definition REPAIRED : rule := Build_rule true true true true true true false.
Definition PUBLISHED : rule := Build_rule true true true false false false false.
(** The repaired rule and Hold. *)
Definition REEL : rule := Build_rule true true true true true true true.

(** The repaired rule with one condition taken out. *)
Definition without_SafeAhead := Build_rule false true true true true true false.
Definition without_CoveredBehind := Build_rule true false true true true true false.
Definition without_Distinct := Build_rule true true false true true true false.
Definition without_UnsureAhead := Build_rule true true true false true true false.
Definition without_FullForFollower := Build_rule true true true true false true false.
Definition without_FullForLeader := Build_rule true true true true true false false.

Inductive role := Leader | Follower.

(** A robot's planned move, as its neighbours see it: where it is, its step, and whether its side is known to be
    open. *)
Record move := { from : cell; does : step; known_open : bool }.

(** P': where the plan sends it. *)
Definition to (m : move) : cell := after (from m) (does m).

(** Whether the robot is sure to arrive: it stays, or its side is known to be open. *)
Definition is_sure (m : move) : bool := match does m with Stay => true | Cross _ => known_open m end.

(** Whether R_i may plan [own] while R_{i+1} plans [ahead]. *)
Definition admits_ahead (r : rule) (own ahead : move) : bool :=
  let safe := negb (safe_ahead r) || covers SAFE (to ahead) (to own) in
  let doubts := hold r || unsure_ahead r && negb (is_sure ahead) in
  safe && (negb doubts || covers COVERED (from ahead) (to own)).

(** Whether a robot may plan to be at [c] while the robot behind it is at [behind]. *)
Definition admits_behind (r : rule) (c behind : cell) : bool :=
  negb (covered_behind r) || covers COVERED behind c.

(** Whether a robot may enter a cell outside the base that [occupants] others occupy now. *)
Definition admits_entry (r : rule) (as_ : role) (occupants : nat) : bool :=
  let guarded := match as_ with Leader => full_for_leader r | Follower => full_for_follower r end in
  negb guarded || (occupants <? 2)%nat.
