(** The tie between the kernel and Spread.v: after any four NOTICEs of three senders, by any hop counts from 0 to 2 of
    theirs, under k = 1, 2, 3 and ∞, and under flooding, a node of the kernel, as published, is what [hears] makes of
    it. What it sends when its wait is over is in NoticeTie.v. *)
From Coq Require Import NArith List Arith.
From Tautline Require Import Spread.
From Tautline.generated Require Import NoticeAnswers.
Import ListNotations.

Definition stage_number (p : phase) : nat :=
  match p with Unaware => 0 | Waiting => 1 | Silent => 2 | Forwarded => 3 end.
Definition code (x : node) : N := N.of_nat (16 * stage_number (stage x) + 4 * parent x + hops x).

(** All lists of so many of these. *)
Fixpoint lists_of (l : list nat) (length : nat) : list (list nat) :=
  match length with 0 => [[]] | S n => flat_map (fun a => map (cons a) (lists_of l n)) l end.

Definition spread_by (k : option nat) : list N :=
  flat_map (fun hops => map (fun senders =>
      code (fold_left (fun x s => hears k x (S s) (nth s hops 0)) senders (unaware me)))
    (lists_of [0; 1; 2] 4)) (lists_of [0; 1; 2] 3).

(** Another k is told apart, and so is a node that takes the last NOTICE of the least hop count, or any. *)
Theorem spread_agrees : flat_map spread_by [Some 1; Some 2; Some 3; None; None] = spread
  /\ spread_by (Some 1) <> spread_by (Some 2) /\ spread_by (Some 2) <> spread_by None.
Proof. split; [vm_cast_no_check (eq_refl spread)|]. split; vm_compute; congruence. Qed.

(** A node of the kernel after any four NOTICEs of two events by three senders, and ends of its wait, with numbered
    events and without. *)
Definition number (x : listener) : N :=
  (256 * N.of_nat (latest x) + N.of_nat (64 * stage_number (stage (with_it x)) + 4 * parent (with_it x)
    + hops (with_it x)))%N.

Definition happening_of (n : nat) : happening := if n =? 6 then Waited else Comes (1 + n / 3) (1 + n mod 3) (n mod 3).

Definition numbered_by (numbers : bool) (k : option nat) : list N :=
  map (fun l => number (after numbers k me (map happening_of l))) (lists_of [0; 1; 2; 3; 4; 5; 6] 4).

(** The two are told apart. *)
Theorem numbered_agrees :
  numbered_by true (Some 1) ++ numbered_by true None ++ numbered_by false (Some 1) ++ numbered_by false None = numbered
  /\ numbered_by true None <> numbered_by false None.
Proof. split; [vm_cast_no_check (eq_refl numbered)|]. vm_compute; congruence. Qed.
