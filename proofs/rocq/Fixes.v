(** FRONTIER-6 and FRONTIER-7, along one axis: which cell a robot takes itself to be in, for every number of moves and
    all bounded errors. Lengths are whole numbers, as the kernel's are; half a cell is [h], any of them. *)
From Coq Require Import ZArith Lia.
Local Open Scope Z_scope.

Definition midpoint (h c : Z) : Z := 2 * h * c.
Definition clamp (low high x : Z) : Z := Z.max low (Z.min high x).

(** The cell from [first] to [last] that a fix is taken for: on the rim between two cells the first one counts. *)
Definition taken_for (h first last fix_ : Z) : Z := clamp first last ((fix_ + (h - 1)) / (2 * h)).
(** The place of cell [c] that is nearest to a fix: what it tells a robot that counts its cell. *)
Definition clamped (h c fix_ : Z) : Z := clamp (midpoint h c - h) (midpoint h c + h) fix_.
(** A place is inside a cell. *)
Definition inside (h c place : Z) : Prop := Z.abs (place - midpoint h c) < h.

Section Robot.
  Variables (h E D : Z) (is_tracked : bool).

  (** Where a robot that has gone to cell [c] believes to be after a fix: there, or at the place of [c] nearest to it. *)
  Definition believed (c fix_ : Z) : Z := if is_tracked then clamped h c fix_ else fix_.

  (** The cell that a robot has moved to last, and where it is: it begins at a midpoint, takes a fix with the error
      [e], and drives as far as it believes to be from the midpoint of a cell [d], with the error [o]. *)
  Inductive run : Z -> Z -> Prop :=
  | run_start : forall c, run c (midpoint h c)
  | run_move : forall c p e d o, run c p -> Z.abs e <= E -> Z.abs o <= D ->
      run d (p + (midpoint h d - believed c (p + e)) + o).
End Robot.

Lemma divided : forall a b q, 0 < b -> b * q <= a < b * q + b -> a / b = q.
Proof. intros a b q B H; symmetry; apply Z.div_unique with (r := a - b * q); lia. Qed.

(** Each fix is taken for the cell in which the robot is, and that is the one that it has moved to. *)
Theorem FRONTIER_6 : forall h E D c p, 0 <= E -> 0 <= D -> 2 * E + D < h -> run h E D false c p ->
  inside h c p /\ forall e, Z.abs e <= E -> forall first last, first <= c <= last -> taken_for h first last (p + e) = c.
Proof.
  intros h E D c p PE PD L R; assert (Z.abs (p - midpoint h c) <= E + D) as H.
  { destruct R as [c | c p e d o R Le Lo]; [lia|]. cbn [believed]; lia. }
  split; [unfold inside; lia|]. intros e Le first last F; unfold taken_for.
  rewrite (divided (p + e + (h - 1)) (2 * h) c); [unfold clamp; lia | lia|]. unfold midpoint in H; lia.
Qed.

(** A robot that counts its cell is in it, before and after every move. *)
Theorem FRONTIER_7 : forall h E D c p, 0 <= E -> 0 <= D -> E + D < h -> run h E D true c p -> inside h c p.
Proof.
  intros h E D c p PE PD L R; unfold inside; induction R as [c | c p e d o R IH Le Lo]; [lia|].
  cbn [believed]; unfold clamped, clamp; lia.
Qed.

(** Both bounds are sharp: at them a fix may be on the rim, and so may a robot. *)
Theorem without_its_bound_FRONTIER_6_breaks : forall E D, 0 <= E -> 0 <= D -> 0 < 2 * E + D ->
  exists p e, run (2 * E + D) E D false 1 p /\ Z.abs e <= E /\ taken_for (2 * E + D) 0 2 (p + e) = 0.
Proof.
  intros E D PE PD L; eexists; exists (- E); split; [|split; [lia|]].
  - apply run_move with (c := 0) (e := E) (o := - D); [apply run_start | lia | lia].
  - cbn [believed]; unfold taken_for, midpoint. rewrite (divided _ _ 0); [reflexivity | lia | lia].
Qed.
Theorem without_its_bound_FRONTIER_7_breaks : forall E D, 0 <= E -> 0 <= D ->
  exists p, run (E + D) E D true 1 p /\ ~ inside (E + D) 1 p.
Proof.
  intros E D PE PD; eexists; split.
  - apply run_move with (c := 0) (e := E) (o := - D); [apply run_start | lia | lia].
  - cbn [believed]; unfold inside, clamped, clamp, midpoint; lia.
Qed.
