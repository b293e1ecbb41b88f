(** What a robot of the chain broadcasts after a team move: its step and what came of it, in one byte, as in
    kernel/src/chain/message.rs. ChainTie.v compares all 256 bytes. *)
From Coq Require Import NArith List Bool.
From Tautline Require Import Lattice.
Import ListNotations.
Local Open Scope N_scope.

(** It is where the plan sent it; it met a wall and stayed; or the step was part of a backtrack. *)
Inductive outcome := Arrived | Blocked | TookBack.

(** Bits 0 to 2: the step's place in direction order. Bit 3: a wall was met. Bit 4: taken back. *)
Definition decode (byte : N) : option (step * outcome) :=
  let outcome :=
    match byte / 8 with 0 => Some Arrived | 1 => Some Blocked | 2 => Some TookBack | _ => None end in
  match nth_error all_steps (N.to_nat (byte mod 8)), outcome with
  | Some Stay, Some Blocked => None
  | Some s, Some o => Some (s, o)
  | _, _ => None
  end.

(** The [k] bytes of a number, the lowest first. *)
Fixpoint bytes (k : nat) (n : N) : list N :=
  match k with O => [] | S k => n mod 256 :: bytes k (n / 256) end.
