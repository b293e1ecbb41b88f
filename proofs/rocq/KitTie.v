(** The tie between the kernel and Kit.v: what the kernel has answered of nodes in reach, of paths that are sure
    to be in contact or apart, and of the drives that it admits to a robot, in generated/KitAnswers.v, is what
    the definitions say; and two robots in a state that can be reached ask nothing else.

    The drives are those of the kernel's second robot, while the first one stands or drives, by the repaired
    rule and without each of the three conditions. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Kit.
From Tautline.generated Require Import KitAnswers.
Import ListNotations.
Local Open Scope Z_scope.

Definition span : Z := 2 * reach + 1.
Definition numbers : list Z := map (fun i => Z.of_nat i - reach) (seq 0 (Z.to_nat span)).

(** Row by row, as the kernel was asked. *)
Definition offsets : list (Z * Z) := flat_map (fun y => map (fun x => (x, y)) numbers) numbers.

Definition stance_of (c : cell) (s : step) : stance := match s with Cross s => Drives c s | Stay => Stands c end.

(** The lowest [k] bits of a number, one after the other. *)
Fixpoint bits (k : nat) (n : N) : list bool :=
  match k with O => [] | S k => N.odd n :: bits k (N.div2 n) end.

Definition same_bits (answers : list bool) (table : N) : bool :=
  forallb (fun x => Bool.eqb (fst x) (snd x)) (combine answers (bits (length answers) table)).

(** The other robot and this one, for each offset of the other robot and each step of the two. *)
Definition pairs : list (stance * stance) :=
  flat_map (fun o => flat_map (fun there => map (fun here => (stance_of (0, 0) here, stance_of o there)) all_steps)
    all_steps) offsets.

(** The questions about drives: this robot stands, the other one stands or drives. *)
Definition questions : list (stance * side) :=
  flat_map (fun o => flat_map (fun there => map (fun s => (stance_of o there, s)) all_sides) all_steps) offsets.

(** The questions of which a bit of the table is set, with the bit of another table. *)
Definition with_bits (asked answers : N) : list ((stance * side) * (bool * bool)) :=
  let k := length questions in combine questions (combine (bits k asked) (bits k answers)).

Definition drives_agree (rl : rule) (asked admitted : N) : bool :=
  forallb (fun x => negb (fst (snd x))
      || Bool.eqb (admits_two rl (Stands (0, 0)) (fst (fst x)) (snd (fst x))) (snd (snd x)))
    (with_bits asked admitted).

(** Wherever two robots are in contact and apart, and one of them stands, all its four sides are in the table. *)
Definition all_asked : bool :=
  forallb (fun x => negb (is_sure_of (Stands (0, 0)) (fst (fst x)) && is_apart_from (Stands (0, 0)) (fst (fst x)))
      || fst (snd x)) (with_bits asked_REPAIRED asked_REPAIRED).

(** Every answer in the table is that of the definitions; without a condition it is not. *)
Theorem kit_answers_agree :
  same_bits (map (in_reach (0, 0)) offsets) reached = true
  /\ same_bits (map (fun p => is_sure_of (fst p) (snd p)) pairs) sure = true
  /\ same_bits (map (fun p => is_apart_from (fst p) (snd p)) pairs) apart = true
  /\ drives_agree REPAIRED asked_REPAIRED admitted_REPAIRED = true
  /\ drives_agree without_NextInReach asked_without_NextInReach admitted_without_NextInReach = true
  /\ drives_agree without_FromInReach asked_without_FromInReach admitted_without_FromInReach = true
  /\ drives_agree without_Apart asked_without_Apart admitted_without_Apart = true
  /\ drives_agree without_NextInReach asked_REPAIRED admitted_REPAIRED = false
  /\ drives_agree without_FromInReach asked_REPAIRED admitted_REPAIRED = false
  /\ drives_agree without_Apart asked_REPAIRED admitted_REPAIRED = false.
Proof. repeat split; vm_compute; reflexivity. Qed.

(** The offsets of the table are wide enough: two robots are never more than 3 apart. *)
Theorem every_drive_is_in_the_table : all_asked = true
  /\ forall t, run 2 t -> Z.abs (fst (left_ (t 0%nat)) - fst (left_ (t 1%nat))) <= reach
                          /\ Z.abs (snd (left_ (t 0%nat)) - snd (left_ (t 1%nat))) <= reach.
Proof.
  split; [vm_compute; reflexivity|]. intros t R; destruct (KIT_1 t R) as [S _].
  unfold is_sure_of in S; rewrite !andb_true_iff in S; destruct S as [[[S _] _] _]; unfold in_reach in S.
  rewrite Z.leb_le in S. assert (reach = 5) as -> by reflexivity.
  set (d := fst (left_ (t 0%nat)) - fst (left_ (t 1%nat))) in *; set (e :=
    snd (left_ (t 0%nat)) - snd (left_ (t 1%nat))) in *.
  clearbody d e. pose proof (Z.square_nonneg d); pose proof (Z.square_nonneg e).
  assert (d * d <= 11) as D by lia; assert (e * e <= 11) as E by lia; clear - D E; split; nia.
Qed.
