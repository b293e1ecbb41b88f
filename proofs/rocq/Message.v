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

Definition encode (m : step * outcome) : N :=
  let place :=
    match fst m with Cross East => 0 | Cross South => 1 | Cross West => 2 | Cross North => 3 | Stay => 4 end in
  place + match snd m with Arrived => 0 | Blocked => 8 | TookBack => 16 end.

(** What the robots ahead of the base say of one team move. *)
Fixpoint decoded (l : list N) : option (list (step * outcome)) :=
  match l with
  | [] => Some []
  | byte :: l =>
      match decode byte, decoded l with Some m, Some more => Some (m :: more) | _, _ => None end
  end.

Definition is_back (m : step * outcome) : bool := match snd m with TookBack => true | Arrived | Blocked => false end.
Definition is_blocked (m : step * outcome) : bool := match snd m with Blocked => true | Arrived | TookBack => false end.

(** The [k] bytes of a number, the lowest first. *)
Fixpoint bytes (k : nat) (n : N) : list N :=
  match k with O => [] | S k => n mod 256 :: bytes k (n / 256) end.
