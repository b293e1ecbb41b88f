(** Cells, steps, edges and environments of [Kovács 2011], section III.A, equation (1), as in
    kernel/src/ground/lattice.rs.

    A cell is a column and a row, whole numbers without bounds. A circle is given by four times its squared
    radius, so that all arithmetic is exact. LATTICE-1: the environments derived from the radii are the sets
    that the paper draws. *)
From Coq Require Import ZArith Lia Bool List.
Import ListNotations.
Local Open Scope Z_scope.

Definition cell : Type := Z * Z.

Definition cell_eqb (a b : cell) : bool := (fst a =? fst b) && (snd a =? snd b).

Lemma cell_eqb_spec : forall a b, cell_eqb a b = true <-> a = b.
Proof.
  intros [x y] [u v]; unfold cell_eqb; cbn; rewrite andb_true_iff, !Z.eqb_eq.
  split; [intros [-> ->]; reflexivity | intros H; injection H; auto].
Qed.

Lemma cell_dec : forall a b : cell, a = b \/ a <> b.
Proof.
  intros a b; destruct (cell_eqb a b) eqn:E; [left | right]; [now apply cell_eqb_spec|].
  intros H; apply cell_eqb_spec in H; congruence.
Qed.

(** The sides of a cell in direction order: +x, +y, -x, -y. A step crosses one of them, or is the null move. *)
Inductive side := East | South | West | North.
Inductive step := Cross (s : side) | Stay.

Definition all_sides := [East; South; West; North].
Definition all_steps := [Cross East; Cross South; Cross West; Cross North; Stay].

Definition offset (s : side) : Z * Z :=
  match s with East => (1, 0) | South => (0, 1) | West => (-1, 0) | North => (0, -1) end.

Definition opposite (s : side) : side :=
  match s with East => West | South => North | West => East | North => South end.

Definition beyond (c : cell) (s : side) : cell := (fst c + fst (offset s), snd c + snd (offset s)).

Definition after (c : cell) (s : step) : cell :=
  match s with Cross s => beyond c s | Stay => c end.

Definition reverse (s : step) : step :=
  match s with Cross s => Cross (opposite s) | Stay => Stay end.

Lemma after_reverse : forall c s, after (after c s) (reverse s) = c.
Proof. intros [x y] [[]|]; cbn; unfold beyond; cbn; try reflexivity; f_equal; lia. Qed.

Lemma after_cross : forall c s, after c (Cross s) <> c.
Proof. intros [x y] []; cbn; unfold beyond; cbn; intros H; injection H; lia. Qed.

(** An edge is named by its western or northern cell and whether it is that cell's east side. *)
Definition edge : Type := cell * bool.

Definition edge_of (c : cell) (s : side) : edge :=
  match s with
  | East => (c, true) | South => (c, false)
  | West => (beyond c West, true) | North => (beyond c North, false)
  end.

Definition edge_eqb (a b : edge) : bool := cell_eqb (fst a) (fst b) && Bool.eqb (snd a) (snd b).

Lemma edge_eqb_spec : forall a b, edge_eqb a b = true <-> a = b.
Proof.
  intros [c a] [d b]; unfold edge_eqb; cbn; rewrite andb_true_iff, cell_eqb_spec, eqb_true_iff.
  split; [intros [-> ->]; reflexivity | intros H; injection H; auto].
Qed.

Lemma edge_of_opposite : forall c s, edge_of (beyond c s) (opposite s) = edge_of c s.
Proof.
  intros [x y] []; unfold edge_of, beyond; cbn; try reflexivity; f_equal; f_equal; lia.
Qed.

(** A cell belongs to the circle with [four_r2] = 4 r^2 if it lies wholly in it. *)
Definition covers (four_r2 : Z) (round c : cell) : bool :=
  (2 * Z.abs (fst round - fst c) + 1) * (2 * Z.abs (fst round - fst c) + 1) +
  (2 * Z.abs (snd round - snd c) + 1) * (2 * Z.abs (snd round - snd c) + 1) <=? four_r2.

(** Whether the centre of the cell lies in the circle. *)
Definition reaches (four_r2 : Z) (round c : cell) : bool :=
  2 * Z.abs (fst round - fst c) * (2 * Z.abs (fst round - fst c)) +
  2 * Z.abs (snd round - snd c) * (2 * Z.abs (snd round - snd c)) <=? four_r2.

(** The circle of E_S, r_safe = 3 sqrt 2 / 2, and that of E_C, r_cov = sqrt 26 / 2. *)
Definition SAFE : Z := 18.
Definition COVERED : Z := 26.

(** E_N: the cell itself or one of its four side neighbours. *)
Definition neighbours (a b : cell) : bool := Z.abs (fst a - fst b) + Z.abs (snd a - snd b) <=? 1.

Definition apart_x (a b : cell) : Z := Z.abs (fst a - fst b).
Definition apart_y (a b : cell) : Z := Z.abs (snd a - snd b).

Lemma E_S_is_the_block : forall a b,
  covers SAFE a b = true <-> apart_x a b <= 1 /\ apart_y a b <= 1.
Proof. intros a b; unfold covers, SAFE, apart_x, apart_y; rewrite Z.leb_le; split; [split|]; nia. Qed.

Lemma E_C_is_the_block_and_four : forall a b,
  covers COVERED a b = true <->
  (apart_x a b <= 1 /\ apart_y a b <= 1)
  \/ (apart_x a b = 2 /\ apart_y a b = 0) \/ (apart_x a b = 0 /\ apart_y a b = 2).
Proof.
  intros a b; unfold covers, COVERED, apart_x, apart_y; rewrite Z.leb_le.
  set (x := Z.abs (fst a - fst b)); set (y := Z.abs (snd a - snd b)).
  assert (0 <= x) by apply Z.abs_nonneg; assert (0 <= y) by apply Z.abs_nonneg.
  split.
  - intros L. assert (x <= 2) by nia. assert (y <= 2) by nia.
    assert (x = 0 \/ x = 1 \/ x = 2) as [->|[->| ->]] by lia; lia.
  - intros [[]|[[-> ->]|[-> ->]]]; nia.
Qed.

Lemma E_N_is_the_cross : forall a b, neighbours a b = true <-> exists s, b = after a s.
Proof.
  intros [x y] [u v]; unfold neighbours; cbn [fst snd]; rewrite Z.leb_le; split.
  - intros L.
    assert ((u = x + 1 /\ v = y + 0) \/ (u = x + 0 /\ v = y + 1) \/ (u = x + -1 /\ v = y + 0)
            \/ (u = x + 0 /\ v = y + -1) \/ (u = x /\ v = y)) as [H|[H|[H|[H|H]]]] by lia; destruct H as [-> ->];
      [exists (Cross East) | exists (Cross South) | exists (Cross West) | exists (Cross North) | exists Stay];
        reflexivity.
  - intros [[[]|] E]; cbn in E; unfold beyond in E; cbn in E; pose proof (f_equal fst E); pose proof (f_equal snd E);
      cbn [fst snd] in *; lia.
Qed.

(** E_N is a cell and its four side neighbours, E_S the block of nine, E_C that block and the four two steps
    straight ahead. *)
Theorem LATTICE_1 : forall a b,
  (neighbours a b = true <-> exists s, b = after a s)
  /\ (covers SAFE a b = true <-> apart_x a b <= 1 /\ apart_y a b <= 1)
  /\ (covers COVERED a b = true <->
       (apart_x a b <= 1 /\ apart_y a b <= 1)
       \/ (apart_x a b = 2 /\ apart_y a b = 0) \/ (apart_x a b = 0 /\ apart_y a b = 2)).
Proof.
  intros a b; split; [apply E_N_is_the_cross | split; [apply E_S_is_the_block | apply E_C_is_the_block_and_four]].
Qed.

Lemma covers_sym : forall r a b, covers r a b = covers r b a.
Proof.
  intros r a b; unfold covers.
  replace (Z.abs (fst b - fst a)) with (Z.abs (fst a - fst b)) by lia.
  replace (Z.abs (snd b - snd a)) with (Z.abs (snd a - snd b)) by lia. reflexivity.
Qed.

Lemma covers_mono : forall r r' a b, r <= r' -> covers r a b = true -> covers r' a b = true.
Proof. intros r r' a b; unfold covers; rewrite !Z.leb_le; lia. Qed.

Lemma covers_self : forall r c, 2 <= r -> covers r c c = true.
Proof. intros r [x y]; unfold covers; cbn; rewrite !Z.sub_diag; cbn; rewrite Z.leb_le; lia. Qed.
