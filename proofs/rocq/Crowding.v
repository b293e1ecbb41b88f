(** CHAIN-2: there are never three robots or more in one cell other than the base.

    For every number of robots, every layout and every order of preference. Of three robots in one cell at most
    one has just come there as planned (Distinct); the others were there, and then it would have found the cell
    full. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Base.
Import ListNotations.

Section Crowding.
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable wall : edge -> bool.
  Hypothesis two_robots : 2 <= N.

  (** No three different robots are in one cell other than the base. *)
  Definition uncrowded (p : team) : Prop :=
    forall i j k, i < N -> j < N -> k < N -> i <> j -> i <> k -> j <> k -> p i = p j -> p j = p k -> p i = base.

  Hypothesis has_distinct : distinct rl = true.
  Hypothesis has_full_for_follower : full_for_follower rl = true.
  Hypothesis has_full_for_leader : full_for_leader rl = true.

  Lemma admitted_distinct : forall st pl i j, admitted N rl base st pl = true -> i < N -> j < N -> i <> j ->
    planned st pl i = planned st pl j -> planned st pl i = base.
  Proof.
    intros st pl i j A Li Lj D E; unfold admitted in A; rewrite !andb_true_iff in A.
    destruct A as [_ A]; rewrite every_spec in A; specialize (A i Li); rewrite every_spec in A; specialize (A j Lj).
    unfold admits_both in A; rewrite has_distinct in A; cbn in A; rewrite !orb_true_iff in A.
    destruct A as [[A|A]|A].
    - now apply Nat.eqb_eq in A.
    - rewrite negb_true_iff in A; apply cell_eqb_spec in E; congruence.
    - now apply cell_eqb_spec.
  Qed.

  (** Who enters a cell other than the base finds fewer than two others there. *)
  Lemma admitted_entry : forall st pl i j k, admitted N rl base st pl = true -> pl 0 = Stay ->
    i < N -> j < N -> k < N -> j <> k -> planned st pl i <> pos st i -> planned st pl i <> base ->
    pos st j = planned st pl i -> pos st k = planned st pl i -> False.
  Proof.
    intros st pl i j k A Z Li Lj Lk D M B Ej Ek.
    destruct i as [|i]; [apply M; unfold planned, to, as_move; cbn; now rewrite Z|].
    pose proof (admitted_robot _ _ _ _ _ _ A Li) as R; unfold admits_robot in R.
    apply andb_true_iff in R; destruct R as [_ R]; rewrite !orb_true_iff in R; destruct R as [[R|R]|R].
    - apply M; unfold stays in R; unfold planned, to, as_move; cbn; now destruct (pl (S i)).
    - apply B; now apply cell_eqb_spec.
    - unfold admits_entry in R.
      rewrite has_full_for_follower, has_full_for_leader in R.
      assert (2 <= occupants N (pos st) (planned st pl (S i))) as O
        by (unfold occupants; apply count_two with (i := j) (j := k); auto; now apply cell_eqb_spec).
      destruct (role_of N (S i)); cbn in R; apply Nat.leb_le in R; lia.
  Qed.

  Lemma crowd_step : forall st pl, pos st 0 = base -> uncrowded (pos st) -> admitted N rl base st pl = true ->
    uncrowded (moved wall (pos st) pl).
  Proof.
    intros st pl _ U A i j k Li Lj Lk Dij Dik Djk Eij Ejk.
    assert (pl 0 = Stay) as Z.
    { unfold admitted in A; rewrite !andb_true_iff in A; destruct A as [[[A _] _] _].
      unfold stays in A; now destruct (pl 0). }
    destruct (cell_dec (moved wall (pos st) pl i) base) as [|NB]; [assumption|exfalso].
    set (c := moved wall (pos st) pl i) in *.
    (* at most one of them is where it planned to be; the others are where they were *)
    assert (forall a b, a < N -> b < N -> a <> b -> planned st pl a = c -> planned st pl b = c -> False) as One.
    { intros a b La Lb D Pa Pb; apply NB; rewrite <- Pa; eapply admitted_distinct with (j := b); eauto; congruence. }
    assert (forall a b d, a < N -> b < N -> d < N -> b <> d ->
              planned st pl a = c -> pos st a <> c -> pos st b = c -> pos st d = c -> False) as Entry.
    { intros a b d La Lb Ld D Pa Oa Pb Pd. apply admitted_entry with (st := st) (pl := pl) (i := a) (j := b) (k := d);
        auto; congruence. }
    assert (pos st i = c -> pos st j = c -> pos st k = c -> False) as Now.
    { intros Pi Pj Pk; apply NB; rewrite <- Pi; apply U with (j := j) (k := k); auto; congruence. }
    assert (moved wall (pos st) pl j = c) as Ej by congruence.
    assert (moved wall (pos st) pl k = c) as Ek by congruence.
    assert (moved wall (pos st) pl i = c) as Ei by reflexivity.
    clearbody c.
    destruct (moved_or_not wall st pl i) as [Hi|Hi], (moved_or_not wall st pl j) as [Hj|Hj],
             (moved_or_not wall st pl k) as [Hk|Hk]; rewrite Ei in Hi; rewrite Ej in Hj; rewrite Ek in Hk;
      symmetry in Hi, Hj, Hk;
      try (apply (One i j); assumption || congruence); try (apply (One i k); assumption || congruence);
      try (apply (One j k); assumption || congruence); auto.
    - destruct (cell_dec (pos st i) c); [auto|]. apply (Entry i j k); auto.
    - destruct (cell_dec (pos st j) c); [auto|]. apply (Entry j i k); auto.
    - destruct (cell_dec (pos st k) c); [auto|]. apply (Entry k i j); auto.
  Qed.

  Theorem uncrowded_always : forall st, reachable N rl base wall st -> uncrowded (pos st).
  Proof.
    intros st [past R].
    destruct (composition N rl base wall uncrowded (fun _ _ => True)) with (past := past) (st := st)
      as [_ [E _]]; auto; try lia.
    - intros p q S U i j k Li Lj Lk D1 D2 D3 E1 E2. rewrite <- S by lia. apply U with (j := j) (k := k); auto;
        rewrite !S by lia; auto.
    - intros i; auto.
    - intros s pl _ B U A; split; [|exact I]. now apply crowd_step.
    - apply explains_inv in E; apply E.
  Qed.
End Crowding.

(** There are never three robots or more in one cell other than the base. *)
Theorem CHAIN_2 : forall N base wall st, 2 <= N -> reachable N REPAIRED base wall st ->
  forall c, c <> base -> occupants N (pos st) c <= 2.
Proof.
  intros N base wall st L R c NB.
  assert (uncrowded N base (pos st)) as U by (eapply uncrowded_always; eauto; reflexivity).
  unfold occupants, count.
  assert (NoDup (filter (fun j => cell_eqb (pos st j) c) (seq 0 N))) as ND by (apply NoDup_filter, seq_NoDup).
  assert (forall j, In j (filter (fun j => cell_eqb (pos st j) c) (seq 0 N)) -> j < N /\ pos st j = c) as IN.
  { intros j H; apply filter_In in H; destruct H as [H E]; apply in_seq in H; apply cell_eqb_spec in E; split;
      [lia|auto]. }
  destruct (filter _ _) as [|i [|j [|k rest]]]; cbn; try lia; exfalso.
  inversion ND as [|? ? N1 ND1]; inversion ND1 as [|? ? N2 ND2]; subst; cbn in N1, N2.
  destruct (IN i) as [Li Pi]; [cbn; auto|]. destruct (IN j) as [Lj Pj]; [cbn; auto|]. destruct (IN k) as [Lk Pk];
    [cbn; auto|].
  apply NB; rewrite <- Pi; apply U with (j := j) (k := k); auto; try congruence; intuition.
Qed.

(** The kernel looks at each planned cell once: it goes along the robots, marks the cells, and refuses a plan that
    comes to a marked cell. *)
Fixpoint marks_none_twice (base : cell) (marked planned : list cell) : bool :=
  match planned with
  | [] => true
  | c :: planned => if cell_eqb c base then marks_none_twice base marked planned
      else negb (existsb (cell_eqb c) marked) && marks_none_twice base (c :: marked) planned
  end.

Lemma marks_none_twice_spec : forall base f n k marked,
  marks_none_twice base marked (map f (seq k n)) = true <->
  (forall i, k <= i < k + n -> f i <> base -> ~ In (f i) marked)
  /\ (forall i j, k <= i < k + n -> k <= j < k + n -> i <> j -> f i = f j -> f i = base).
Proof.
  induction n as [|n IH]; intros k marked; cbn [seq map marks_none_twice].
  - split; [split; intros; lia | reflexivity].
  - assert (existsb (cell_eqb (f k)) marked = true <-> In (f k) marked) as X.
    { rewrite existsb_exists; split; [intros [x [I E]]; apply cell_eqb_spec in E; now rewrite E|].
      intros I; exists (f k); split; [exact I | now apply cell_eqb_spec]. }
    destruct (cell_eqb (f k) base) eqn:B.
    + apply cell_eqb_spec in B; rewrite IH; split; intros [M D]; (split; [intros i I; destruct (Nat.eq_dec i k) as [->|];
        [try contradiction; try (apply M; lia) | apply M; lia]|]).
      * intros i j I J U E; destruct (Nat.eq_dec i k) as [->|], (Nat.eq_dec j k) as [->|]; try congruence.
        apply (D i j); auto; lia.
      * intros i j I J; apply D; lia.
    + assert (f k <> base) as B' by (intros Y; apply cell_eqb_spec in Y; congruence).
      rewrite andb_true_iff, negb_true_iff, <- not_true_iff_false, X, IH; split.
      * intros [N [M D]]; split.
        -- intros i I U; destruct (Nat.eq_dec i k) as [->|]; [exact N|]. intros Y; apply (M i); auto; [lia | now right].
        -- intros i j I J U E; destruct (Nat.eq_dec i k) as [->|], (Nat.eq_dec j k) as [->|]; try congruence.
           ++ destruct (cell_dec (f j) base) as [|V]; [congruence|]. exfalso; apply (M j); auto; [lia | left; congruence].
           ++ destruct (cell_dec (f i) base) as [|V]; [congruence|]. exfalso; apply (M i); auto; [lia | left; congruence].
           ++ apply (D i j); auto; lia.
      * intros [M D]; split; [apply M; auto; lia|]. split.
        -- intros i I U [Y|Y]; [apply B'; apply (D k i); auto; lia | apply (M i); auto; lia].
        -- intros i j I J; apply D; lia.
Qed.

(** A plan of which the base stays passes if and only if every robot has a cell of its own, the base excepted. *)
Theorem marking_is_enough : forall N base st pl, 1 <= N -> planned st pl 0 = base ->
  (marks_none_twice base [] (map (planned st pl) (seq 1 (pred N))) = true <->
   forall i j, i < N -> j < N -> i <> j -> planned st pl i = planned st pl j -> planned st pl i = base).
Proof.
  intros N base st pl L Z; rewrite marks_none_twice_spec; split.
  - intros [_ D] i j I J U E; destruct i as [|i]; [exact Z|]. destruct j as [|j]; [congruence|]. apply (D (S i) (S j)); auto; lia.
  - intros D; split; [auto|]. intros i j I J; apply D; lia.
Qed.

(** In an admitted plan every robot has a cell of its own, the base excepted: the kernel's pass finds nothing. *)
Theorem CHAIN_5 : forall N rl base wall st pl, 1 <= N -> distinct rl = true -> reachable N rl base wall st ->
  admitted N rl base st pl = true ->
  (forall i j, i < N -> j < N -> i <> j -> planned st pl i = planned st pl j -> planned st pl i = base)
  /\ marks_none_twice base [] (map (planned st pl) (seq 1 (pred N))) = true.
Proof.
  intros N rl base wall st pl L D R A; assert (planned st pl 0 = base) as Z.
  { destruct R as [past R]; destruct (CHAIN_6 N rl base wall past st L R) as [F S]; specialize (S pl A).
    unfold planned, to, as_move; cbn; rewrite S; cbn.
    destruct (composition N rl base wall (fun _ => True) (fun _ _ => True)) with (past := past) (st := st)
      as [_ [E _]]; auto. apply explains_inv in E; apply E. }
  assert (forall i j, i < N -> j < N -> i <> j -> planned st pl i = planned st pl j -> planned st pl i = base) as O
    by (intros; eapply admitted_distinct; eauto).
  split; [exact O | now apply marking_is_enough].
Qed.
