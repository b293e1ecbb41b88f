(** MRC-12, of calls that a robot has a record of: it sets the SBit when it is told whom the WFR has chosen, or has
    asked in vain, and keeps it until it hears a newer call, or takes the record's room for another WFR. *)
From Coq Require Import List Bool Arith.
From Tautline Require Import Mrc Leases.
Import ListNotations.

Definition with_bit (q : request) : request := {| wfr_of := wfr_of q; epoch := epoch q; served := true |}.

Lemma served_record : forall w v x q, record_of x w = Some q ->
  record_of (serve v x) w = Some (if w =? v then with_bit q else q).
Proof.
  intros w v x q R; assert (wfr_of q = w) as W by (apply find_some in R; destruct R as [_ A]; now apply Nat.eqb_eq in A).
  unfold record_of, serve in *; cbn [requests]; rewrite find_change by auto.
  destruct (Nat.eqb_spec w v) as [<-|D]; [now rewrite R | exact R].
Qed.

(** What it then asks for changes no record. *)
Lemma asks_record : forall r z y out w, In (y, out) (asks r z) -> record_of y w = record_of z w.
Proof. intros r z y out w H; apply asks_requests in H; unfold record_of; now rewrite H. Qed.

Lemma heeds_record : forall r x v e c y out w q, record_of x w = Some q ->
  In (y, out) (heeds REPAIRED r x v e c) ->
  record_of y w = Some q \/ record_of y w = Some (with_bit q).
Proof.
  intros r x v e c y out w q R H; unfold heeds in H.
  destruct (record_of x v) as [p|]; [|destruct H as [[= <- <-]|[]]; auto].
  destruct (epochs REPAIRED && negb (epoch p =? e)); [destruct H as [[= <- <-]|[]]; auto|].
  pose proof (served_record w v x q R) as S.
  assert (record_of (serve v x) w = Some q \/ record_of (serve v x) w = Some (with_bit q)) as G
    by (rewrite S; destruct (w =? v); auto).
  destruct (match c with Some c => c =? r | None => false end).
  - destruct H as [[= <- <-]|[]]. destruct (_ || _); exact G.
  - apply asks_record with (w := w) in H; rewrite H. destruct (_ || _); exact G.
Qed.

Theorem MRC_12 : forall r x w q, record_of x w = Some q ->
  (forall c y out, In (y, out) (robot_outcomes REPAIRED r x (Told (Resb w (epoch q) r c))) ->
     record_of y w = Some {| wfr_of := w; epoch := epoch q; served := true |})
  /\ (forall e y out, doing x = Asking w e -> In (y, out) (robot_outcomes REPAIRED r x Waited) ->
     (y, out) = (x, [Move w e r]) \/ record_of y w = Some {| wfr_of := w; epoch := epoch q; served := true |})
  /\ (served q = true -> forall i y out, In (y, out) (robot_outcomes REPAIRED r x i) ->
     record_of y w = Some q
     \/ (exists e, i = Told (Notice w e) /\ epoch q < e)
     \/ (exists v e, i = Told (Notice v e) /\ record_of x v = None)).
Proof.
  intros r x w q R.
  assert (wfr_of q = w) as W by (apply find_some in R; destruct R as [_ A]; now apply Nat.eqb_eq in A).
  assert (record_of (serve w x) w = Some {| wfr_of := w; epoch := epoch q; served := true |}) as S
    by (rewrite (served_record w w x q R), Nat.eqb_refl; unfold with_bit; now rewrite W).
  split; [|split].
  - intros c y out H; cbn in H; rewrite Nat.eqb_refl in H; unfold heeds in H; rewrite R, Nat.eqb_refl in H; cbn [epochs
      REPAIRED negb andb] in H.
    destruct (match c with Some c => c =? r | None => false end).
    + destruct H as [[= <- <-]|[]]. destruct (_ || _); exact S.
    + apply asks_record with (w := w) in H; rewrite H. destruct (_ || _); exact S.
  - intros e y out D H; cbn in H; rewrite D in H; cbn [In] in H. destruct H as [H|H]; [left; congruence|right].
    apply asks_record with (w := w) in H; rewrite H; exact S.
  - intros B.
    assert (with_bit q = q) as Q by (destruct q; cbn in *; subst; reflexivity).
    assert (forall v t, record_of (now (serve v x) t) w = Some q) as K.
    { intros v t; change (record_of (serve v x) w = Some q).
      rewrite (served_record w v x q R), Q; now destruct (w =? v). }
    assert (forall t y out, In (y, out) (asks r (now x t)) -> record_of y w = Some q) as A
      by (intros t y out H; apply asks_record with (w := w) in H; rewrite H; exact R).
    assert (forall y (out : list message) o, In (y, out) [(x, o)] -> record_of y w = Some q) as N
      by (intros y out o [[= <- <-]|[]]; exact R).
    intros [[v e|v e c|v e to c|v e c|v e c]| | |v e] y out H; cbn [robot_outcomes] in H; try (left; eapply N; exact H).
    + apply in_flat_map in H; destruct H as [z [Z H]]. apply asks_record with (w := w) in H.
      destruct (record_of x v) as [p|] eqn:V; [|right; right; eauto].
      unfold notes in Z; rewrite V in Z; cbn [epochs REPAIRED] in Z.
      destruct (Nat.ltb_spec (epoch p) e) as [L|L]; [|destruct Z as [<-|[]]; left; congruence].
      destruct (Nat.eq_dec v w) as [->|D]; [right; left; exists e; split; congruence|left].
      destruct Z as [<-|[]]; rewrite H; unfold record_of in *; cbn [requests].
      rewrite find_change by auto. apply not_eq_sym, Nat.eqb_neq in D; now rewrite D.
    + destruct (to =? r); [|left; eapply N; exact H].
      left. destruct (heeds_record _ _ _ _ _ _ _ _ _ R H) as [G|G]; congruence.
    + destruct (doing x) as [|v e|v e]; try (left; eapply N; exact H).
      destruct H as [[= <- <-]|H]; left; [exact R|]. apply asks_record with (w := w) in H; rewrite H; apply K.
    + destruct (doing x); left; try (eapply A; exact H).
      all: apply asks_record with (w := w) in H; congruence.
    + destruct (doing x) as [|v' e'|v' e']; try (left; eapply N; exact H).
      destruct (_ && _); left; [eapply A; exact H | eapply N; exact H].
Qed.

(** A call of a WFR that has no record may take a served record's room, so the exception is needed. *)
Theorem without_a_record_breaks_MRC_12 : exists x y q,
  record_of x 1 = Some q /\ served q = true
  /\ In (y, []) (robot_outcomes REPAIRED 1 x (Told (Notice 2 1))) /\ record_of y 1 = None.
Proof.
  exists {| requests := [{| wfr_of := 1; epoch := 1; served := true |}]; doing := Free |},
    {| requests := [{| wfr_of := 2; epoch := 1; served := false |}]; doing := Free |},
    {| wfr_of := 1; epoch := 1; served := true |}.
  repeat split; vm_compute; auto 12.
Qed.
