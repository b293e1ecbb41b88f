(** The marking half of BRICKS-2: the accessible cells stay connected when an agent marks a cell as BRICKS-1
    demands.

    On every floor, of any size and shape, and on any graph: nothing is planar here. BRICKS-1 says that the
    accessible side neighbours of the cell stay connected with each other without it; its 256 neighbourhoods are
    checked in Rust. Shutting a side, the other half of BRICKS-2, is not proved here. *)
From Coq Require Import List Lia Arith.
Import ListNotations.

Section Marking.
  Variable cell : Type.
  Hypothesis cell_dec : forall a b : cell, a = b \/ a <> b.
  Variable beside : cell -> cell -> Prop.
  Hypothesis beside_sym : forall a b, beside a b -> beside b a.

  (** Ways over the cells of [free], one after the other beside each other. *)
  Inductive way (free : cell -> Prop) : cell -> cell -> Prop :=
  | here : forall a, free a -> way free a a
  | onward : forall a b c, free a -> beside a b -> way free b c -> way free a c.

  Lemma way_trans : forall free a b c, way free a b -> way free b c -> way free a c.
  Proof. intros free a b c W; induction W; intros V; auto. eapply onward; eauto. Qed.

  Definition connected (free : cell -> Prop) : Prop := forall a b, free a -> free b -> way free a b.
  Definition unmarked (free : cell -> Prop) (v : cell) (a : cell) : Prop := free a /\ a <> v.

  Lemma marking_keeps_connected : forall free v,
    connected free ->
    (forall a b, unmarked free v a -> unmarked free v b -> beside a v -> beside v b -> way (unmarked free v) a b) ->
    connected (unmarked free v).
  Proof.
    intros free v C B.
    assert (forall a b, way free a b -> b <> v ->
              (a <> v -> way (unmarked free v) a b)
              /\ (a = v -> exists n, beside v n /\ unmarked free v n /\ way (unmarked free v) n b)) as G.
    { intros a b W; induction W as [a F | a n b F E W IH]; intros Nb.
      - split; [intros; constructor; split; auto | intros ->; contradiction].
      - destruct (IH Nb) as [I1 I2]. split.
        + intros Na; destruct (cell_dec n v) as [->|Nn].
          * destruct (I2 eq_refl) as [m [Em [Um Wm]]].
            eapply way_trans; [|exact Wm]. apply B; auto; split; auto.
          * eapply onward; [split; auto | exact E | auto].
        + intros ->; destruct (cell_dec n v) as [->|Nn]; [auto|].
          exists n; repeat split; auto. clear - W. destruct W; auto. }
    intros a b [Fa Na] [Fb Nb]. destruct (G a b (C a b Fa Fb) Nb) as [H _]; auto.
  Qed.
End Marking.

(** The accessible cells stay connected, however many cells are marked one after the other. [marks] leads from
    one set of accessible cells to the next by marking one cell, as BRICKS-1 demands. *)
Section Run.
  Variable cell : Type.
  Variable beside : cell -> cell -> Prop.

  Inductive marks : (cell -> Prop) -> (cell -> Prop) -> Prop :=
  | marks_none : forall free, marks free free
  | marks_one : forall free next last v,
      (forall a, next a <-> unmarked cell free v a) ->
      (forall a b, unmarked cell free v a -> unmarked cell free v b -> beside a v -> beside v b ->
        way cell beside (unmarked cell free v) a b) ->
      marks next last -> marks free last.
End Run.

Lemma way_same : forall cell beside free free' a b, (forall c : cell, free' c <-> free c) ->
  way cell beside free a b -> way cell beside free' a b.
Proof.
  intros cell beside free free' a b E W; induction W as [a F | a b c F B W IH]; [constructor; now apply E|].
  eapply onward; [apply E; exact F | exact B | exact IH].
Qed.

Theorem BRICKS_2_marking : forall (cell : Type) (beside : cell -> cell -> Prop) (free last : cell -> Prop),
  (forall a b : cell, a = b \/ a <> b) -> (forall a b, beside a b -> beside b a) ->
  marks cell beside free last -> connected cell beside free -> connected cell beside last.
Proof.
  intros cell beside free last D S M; induction M as [|free next last v E B M IH]; intros C; [exact C|].
  apply IH; intros a b Fa Fb; eapply way_same; [exact E|].
  apply marking_keeps_connected; auto; now apply E.
Qed.
