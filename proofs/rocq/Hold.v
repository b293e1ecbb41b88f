(** CHAIN-19: contact whichever robots do not go, and in whatever order they go, by the condition Hold: P'_i is
    always in E_C of P_{i+1}.

    A robot that the message of a move does not reach, that breaks down, that meets a wall where there was none,
    or that is slow, is where it was while others have gone on. Here the world picks in every team move any set
    of robots that go, in an advance and in a take-back alike; no layout is needed, since a wall is one reason
    among others. When a move is only taken back in part, what lay before it in the history is forgotten. The
    kernel's answers by the rule with Hold are compared in ChainTie.v. *)
From Coq Require Import ZArith QArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Plane.
Import ListNotations.
Local Open Scope nat_scope.

(** All four pairs of ends are in E_C: [p], [q] of one robot, [p'], [q'] of the robot ahead of it. *)
Definition close (p q p' q' : cell) : Prop :=
  covers COVERED p p' = true /\ covers COVERED p q' = true /\ covers COVERED q p' = true /\ covers COVERED q q' = true.

(** What the rule with Hold asks of two neighbours; of who stays where it is no CoveredBehind, as of the leader's
    null move. *)
Definition admits_hold (own ahead : move) : bool :=
  admits_ahead REEL own ahead
  && (cell_eqb (to ahead) (from ahead) || admits_behind REEL (to ahead) (from own)).

Lemma pair_hold : forall own ahead, covers COVERED (from own) (from ahead) = true -> admits_hold own ahead = true ->
  close (from own) (to own) (from ahead) (to ahead).
Proof.
  intros own ahead C A; unfold admits_hold, admits_ahead, admits_behind in A; cbn in A.
  rewrite !andb_true_iff, orb_true_iff in A; destruct A as [[S U] B].
  repeat split; auto.
  - destruct B as [B|B]; [apply cell_eqb_spec in B; now rewrite B | exact B].
  - now rewrite covers_sym.
  - rewrite covers_sym; eapply covers_mono; [|exact S]; unfold SAFE, COVERED; lia.
Qed.

(** A team that holds: where its robots are, and where they were before the advances that can be taken back. *)
Record holding := { places : team; before : list team }.

Definition moves_of (p : team) (pl : plan) (i : nat) : move := {| from := p i; does := pl i; known_open := false |}.

(** Where robots are while those in [gone] have gone to [q], and the others have not. *)
Definition partly (gone : nat -> bool) (p q : team) : team := fun i => if gone i then q i else p i.

Section Team.
  Variable N : nat.
  Variable base : cell.

  Definition admitted_hold (p : team) (pl : plan) : Prop :=
    forall i, S i < N -> admits_hold (moves_of p pl i) (moves_of p pl (S i)) = true.

  Definition sent_by (p : team) (pl : plan) : team := fun i => after (p i) (pl i).

  (** [tries h q] : the team is about to go from [places h] to [q], by an admitted plan or by taking its last
      advance back. *)
  Inductive tries (h : holding) : team -> Prop :=
  | tries_plan : forall pl, admitted_hold (places h) pl -> tries h (sent_by (places h) pl)
  | tries_back : forall q rest, before h = q :: rest -> tries h q.

  (** What is known to be undone is forgotten; of a move taken back in part only, all that lay before it. *)
  Inductive holds_on : holding -> Prop :=
  | hold_start : holds_on {| places := fun _ => base; before := [] |}
  | hold_advance : forall h pl gone, holds_on h -> admitted_hold (places h) pl ->
      holds_on {| places := partly gone (places h) (sent_by (places h) pl); before := places h :: before h |}
  | hold_back : forall h q rest gone, holds_on h -> before h = q :: rest -> every N gone = true ->
      holds_on {| places := partly gone (places h) q; before := rest |}
  | hold_back_partly : forall h q rest gone, holds_on h -> before h = q :: rest ->
      holds_on {| places := partly gone (places h) q; before := [] |}.

  Definition close_teams (p q : team) : Prop := forall i, S i < N -> close (p i) (q i) (p (S i)) (q (S i)).

  Fixpoint explained (p : team) (l : list team) : Prop :=
    match l with
    | [] => forall i, S i < N -> covers COVERED (p i) (p (S i)) = true
    | q :: rest => close_teams p q /\ explained q rest
    end.

  Lemma explained_contact : forall p l, explained p l -> forall i, S i < N -> covers COVERED (p i) (p (S i)) = true.
  Proof. intros p [|q l] E i L; [now apply E | apply E; exact L]. Qed.

  Lemma explained_same : forall p q l, (forall i, i < N -> p i = q i) -> explained p l -> explained q l.
  Proof.
    intros p q [|o l] S E; cbn in *.
    - intros i L; rewrite <- !S by lia; now apply E.
    - destruct E as [C E]; split; [|exact E]. intros i L; rewrite <- !S by lia; now apply C.
  Qed.

  Lemma close_admitted : forall p pl, (forall i, S i < N -> covers COVERED (p i) (p (S i)) = true) ->
    admitted_hold p pl ->
    close_teams p (sent_by p pl).
  Proof.
    intros p pl C A i L. apply (pair_hold (moves_of p pl i) (moves_of p pl (S i))); [now apply C | now apply A].
  Qed.

  (** Whoever has gone: with the present places, the places before, and those to come, all corners are in E_C. *)
  Lemma close_partly : forall gone gone' p q, close_teams p q -> close_teams (partly gone p q) (partly gone' p q).
  Proof.
    intros gone gone' p q C i L; destruct (C i L) as [A [B [D E]]]; unfold partly.
    destruct (gone i), (gone (S i)), (gone' i), (gone' (S i)); repeat split; auto.
  Qed.

  Lemma holding_explained : forall h, holds_on h -> explained (places h) (before h).
  Proof.
    intros h H; induction H as [|h pl gone H IH A|h q rest gone H IH B G|h q rest gone H IH B]; cbn.
    - intros i L; apply covers_self; unfold COVERED; lia.
    - split; [|exact IH].
      pose proof (close_admitted _ _ (explained_contact _ _ IH) A) as C.
      intros i L; pose proof (close_partly gone (fun _ => false) _ _ C i L) as X; exact X.
    - rewrite B in IH; destruct IH as [_ E]. eapply explained_same; [|exact E].
      intros i L; rewrite every_spec in G; unfold partly; now rewrite G.
    - rewrite B in IH; destruct IH as [C _]; intros i L.
      destruct (close_partly gone gone _ _ C i L) as [X _]; exact X.
  Qed.

  Lemma tries_close : forall h q, holds_on h -> tries h q -> close_teams (places h) q.
  Proof.
    intros h q H T; pose proof (holding_explained h H) as E; destruct T as [pl A | q rest B].
    - apply close_admitted; [now apply (explained_contact _ _ E) | exact A].
    - rewrite B in E; apply E.
  Qed.
End Team.

(** Under Hold neighbours are in E_C of each other at every moment of every team move, whichever robots have
    gone by then and in whatever order, and whichever never go: after a plan and after a take-back. *)
Theorem CHAIN_19 : forall N base h q gone, holds_on N base h -> tries N h q ->
  forall i, S i < N -> covers COVERED (partly gone (places h) q i) (partly gone (places h) q (S i)) = true.
Proof.
  intros N base h q gone H T i L.
  destruct (close_partly N gone gone _ _ (tries_close N base h q H T) i L) as [C _]; exact C.
Qed.

(** And while they drive, at whatever speeds and with whatever pauses, their centres are within r_cov, 4 r_cov^2
    = 26. *)
Theorem hold_keeps_coverage : forall N base h q, holds_on N base h -> tries N h q ->
  forall i s t, S i < N -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (norm2 (minus (between s (centre (places h i)) (centre (q i)))
                (between t (centre (places h (S i))) (centre (q (S i))))) <= 26 # 4)%Q.
Proof.
  intros N base h q H T i s t L S T'; destruct (tries_close N base h q H T i L) as [A [B [C D]]].
  assert (forall a b, covers COVERED a b = true -> (norm2 (minus (centre a) (centre b)) <= 26 # 4)%Q) as R.
  { intros a b E; apply norm2_centres; unfold covers, COVERED in E; rewrite Z.leb_le in E; nia. }
  apply corners_decide; auto.
Qed.

(** With the exception of UnsureAhead it is not so: R_3 goes south over a side that is known to be open and R_2
    goes east. If R_3 does not go, R_2 is not in E_C of it. *)
Theorem unsure_ahead_does_not_hold : exists own ahead,
  covers COVERED (from own) (from ahead) = true
  /\ admits_ahead REPAIRED own ahead = true /\ admits_behind REPAIRED (to ahead) (from own) = true
  /\ covers COVERED (to own) (from ahead) = false.
Proof.
  exists {| from := (0, 0)%Z; does := Cross East; known_open := true |},
         {| from := (0, -2)%Z; does := Cross South; known_open := true |}.
  repeat split; vm_compute; reflexivity.
Qed.

(** What the rule with Hold admits of a whole team is admitted here, and by the repaired rule; so CHAIN_1 and
    CHAIN_2 speak of its runs, too. *)
Lemma hold_admits_less : forall own ahead, admits_ahead REEL own ahead = true -> admits_ahead REPAIRED own ahead = true.
Proof.
  intros own ahead A; unfold admits_ahead in *; cbn in *.
  apply andb_true_iff in A; destruct A as [S U]; rewrite S, U; now rewrite orb_true_r.
Qed.

Theorem admitted_is_held : forall N base st pl, admitted N REEL base st pl = true ->
  admitted_hold N (pos st) pl.
Proof.
  intros N base st pl A i L; unfold admits_hold; apply andb_true_iff; split.
  - exact (admitted_ahead N REEL base st pl i A L).
  - apply orb_true_iff; destruct (admitted_behind N REEL base st pl i A L) as [E|E]; [left | right; exact E].
    apply cell_eqb_spec; exact E.
Qed.

Theorem held_is_repaired : forall N base wall st, reachable N REEL base wall st -> reachable N REPAIRED base wall st.
Proof.
  intros N base wall st [past R]; exists past; induction R as [st A|past st pl st' R IH A K|past st pl rest st' R IH E K].
  - now apply run_start.
  - eapply run_advance; [exact IH| |exact K].
    unfold admitted in *; rewrite !andb_true_iff in *; destruct A as [[[B A] S] D]; repeat split; auto.
    rewrite every_spec in *; intros i L; now apply hold_admits_less, A.
  - eapply run_backtrack; eauto.
Qed.
