(** Points between cells, and that distance is convex: where two robots are at any moment, whatever parts of
    their straight ways they have gone, they are no farther from each other than the ends of their ways.

    Points have rational coordinates. A part of a way is a rational number from 0 to 1; what holds of all of
    them holds of real ones, too, since distance is continuous. *)
From Coq Require Import ZArith QArith Lia Lqa.
From Tautline Require Import Lattice.

Local Open Scope Q_scope.
Definition point : Type := Q * Q.
(** The square of the length. *)
Definition norm2 (v : point) : Q := fst v * fst v + snd v * snd v.
Definition minus (a b : point) : point := (fst a - fst b, snd a - snd b).
(** Somewhere between two points, the part [t] of the way gone. *)
Definition between (t : Q) (a b : point) : point :=
  ((1 - t) * fst a + t * fst b, (1 - t) * snd a + t * snd b).
(** The centre of a cell. *)
Definition centre (c : cell) : point := (inject_Z (fst c), inject_Z (snd c)).

Lemma square_le : forall x : Q, 0 <= x * x.
Proof. intros [n d]; unfold Qle, Qmult; cbn [Qnum Qden]; nia. Qed.

Lemma convex : forall t a b r, 0 <= t <= 1 -> norm2 a <= r -> norm2 b <= r -> norm2 (between t a b) <= r.
Proof.
  intros t [ax ay] [bx by_] r [T0 T1] A B; unfold norm2, between in *; cbn in *.
  assert (0 <= t * (1 - t)) as T by (apply Qmult_le_0_compat; lra).
  pose proof (square_le (ax - bx)) as DX; pose proof (square_le (ay - by_)) as DY.
  assert (0 <= t * (1 - t) * ((ax - bx) * (ax - bx) + (ay - by_) * (ay - by_))) as D
    by (apply Qmult_le_0_compat; [exact T | lra]).
  assert (((1 - t) * ax + t * bx) * ((1 - t) * ax + t * bx) + ((1 - t) * ay + t * by_) * ((1 - t) * ay + t * by_)
          == (1 - t) * (ax * ax + ay * ay) + t * (bx * bx + by_ * by_)
             - t * (1 - t) * ((ax - bx) * (ax - bx) + (ay - by_) * (ay - by_))) as E by ring.
  rewrite E.
  assert ((1 - t) * (ax * ax + ay * ay) <= (1 - t) * r) as LA
    by (rewrite !(Qmult_comm (1 - t)); apply Qmult_le_compat_r; lra).
  assert (t * (bx * bx + by_ * by_) <= t * r) as LB by (rewrite !(Qmult_comm t); apply Qmult_le_compat_r; lra).
  lra.
Qed.

Lemma norm2_proper : forall a b : point, fst a == fst b -> snd a == snd b -> norm2 a == norm2 b.
Proof. intros a b X Y; unfold norm2; rewrite X, Y; reflexivity. Qed.

(** One is somewhere between [p] and [q], the other between [p'] and [q']: the four distances of ends decide. *)
Lemma corners_decide : forall p q p' q' r s t,
  norm2 (minus (centre p) (centre p')) <= r -> norm2 (minus (centre p) (centre q')) <= r ->
  norm2 (minus (centre q) (centre p')) <= r -> norm2 (minus (centre q) (centre q')) <= r ->
  0 <= s <= 1 -> 0 <= t <= 1 ->
  norm2 (minus (between s (centre p) (centre q)) (between t (centre p') (centre q'))) <= r.
Proof.
  intros p q p' q' r s t A B C D S T.
  pose proof (convex t _ _ _ T A B) as L; pose proof (convex t _ _ _ T C D) as M.
  pose proof (convex s _ _ _ S L M) as X.
  erewrite norm2_proper; [exact X | |]; unfold between, minus; cbn; ring.
Qed.

(** Distances of centres are whole numbers. *)
Lemma norm2_centres : forall a b (k : Z) (d : positive),
  (Z.pos d * ((fst a - fst b) * (fst a - fst b) + (snd a - snd b) * (snd a - snd b)) <= k)%Z ->
  norm2 (minus (centre a) (centre b)) <= k # d.
Proof.
  intros [x y] [u v] k d H; cbn [fst snd] in H.
  assert (norm2 (minus (centre (x, y)) (centre (u, v)))
          == inject_Z ((x - u) * (x - u) + (y - v) * (y - v))) as ->.
  { unfold norm2, minus, centre; cbn [fst snd]; unfold Zminus.
    rewrite !inject_Z_plus, !inject_Z_mult, !inject_Z_plus, !inject_Z_opp; ring. }
  unfold Qle, inject_Z; cbn [Qnum Qden]; lia.
Qed.
