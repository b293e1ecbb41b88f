(** CHAIN-4: what a planner proposes is returned if it is admitted and leads over no known wall, and refused if not.

    For every number of robots, every rule, every map and every planner. The kernel decides that in one pass over the
    robots, [Rule::admits_plan] of kernel/src/chain/admission.rs, in which cells are marked and never compared with each
    other: that the marks are enough is proved here. AdmissionTie.v compares its answers. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Crowding.
Import ListNotations.

(** Cells that come twice or more often: those that are marked already are marked once more. *)
Fixpoint marked_full (cells once full : list cell) : list cell :=
  match cells with
  | [] => full
  | c :: cells =>
      if existsb (cell_eqb c) once then marked_full cells once (c :: full) else marked_full cells (c :: once) full
  end.

Section Admission.
  Variables (N : nat) (rl : rule) (base : cell) (met : edge -> bool).

  (** Known walls. *)
  Definition is_wall (st : state) (pl : plan) (i : nat) : bool :=
    match pl i with Cross s => met (edge_of (pos st i) s) | Stay => false end.

  Definition admits_pair (st : state) (pl : plan) (i : nat) : bool :=
    negb (is_wall st pl (S i))
    && ((is_leader N (S i) && stays pl (S i)) || admits_behind rl (planned st pl (S i)) (pos st i))
    && admits_ahead rl (as_move st pl i) (as_move st pl (S i)).

  Definition admits_entries (st : state) (pl : plan) : bool :=
    (admits_entry rl Leader 2 && admits_entry rl Follower 2)
    || let full := marked_full (filter (fun c => negb (cell_eqb c base)) (map (pos st) (seq 0 N))) [] [] in
       every (pred N) (fun i => stays pl (S i) || admits_entry rl (role_of N (S i)) 2
         || negb (existsb (cell_eqb (planned st pl (S i))) full)).

  Definition admits_plan (st : state) (pl : plan) : bool :=
    stays pl 0
    && (negb (distinct rl) || marks_none_twice base [] (map (planned st pl) (seq 1 (pred N))))
    && every (pred N) (admits_pair st pl)
    && admits_entries st pl.

  (** What the kernel returns: [Chain::plan]. *)
  Definition returned (st : state) (pl : plan) : plan := if admits_plan st pl then pl else fun _ => Stay.

  Definition is_free (st : state) (pl : plan) : Prop := forall i, i < N -> is_wall st pl i = false.

  Lemma existsb_cell : forall l c, existsb (cell_eqb c) l = true <-> In c l.
  Proof.
    intros l c; rewrite existsb_exists; split; [intros [x [I E]]; apply cell_eqb_spec in E; now subst|].
    intros I; exists c; split; [exact I | now apply cell_eqb_spec].
  Qed.

  Definition times (c : cell) (l : list cell) : nat := length (filter (fun d => cell_eqb d c) l).

  Lemma times_cons : forall c d l, times c (d :: l) = (if cell_eqb d c then 1 else 0) + times c l.
  Proof. intros c d l; unfold times; cbn. now destruct (cell_eqb d c). Qed.

  Lemma marked_full_spec : forall l c once full, In c (marked_full l once full) <->
    In c full \/ 2 <= times c l \/ In c once /\ 1 <= times c l.
  Proof.
    induction l as [|d l IH]; intros c once full; cbn [marked_full].
    - unfold times; cbn; split; [auto | intros [H|[H|[_ H]]]; [exact H | lia | lia]].
    - rewrite times_cons. destruct (existsb (cell_eqb d) once) eqn:E; rewrite IH; cbn [In].
      + apply existsb_cell in E. destruct (cell_eqb d c) eqn:D; [apply cell_eqb_spec in D; subst d|].
        * split; [intros [[_|H]|[H|[H K]]]; auto; right; right; split; auto; lia|].
          intros [H|[H|[H K]]]; auto.
        * assert (d <> c) by (intros X; apply cell_eqb_spec in X; congruence). cbn [plus]. tauto.
      + assert (~ In d once) as F by (intros X; apply existsb_cell in X; congruence).
        destruct (cell_eqb d c) eqn:D; [apply cell_eqb_spec in D; subst d|].
        * split; [intros [H|[H|[_ H]]]; auto; right; left; lia|].
          intros [H|[H|[H _]]]; auto; [right; right; split; auto; lia | contradiction].
        * assert (d <> c) by (intros X; apply cell_eqb_spec in X; congruence). cbn [plus]. tauto.
  Qed.

  Lemma times_occupants : forall p c, c <> base ->
    times c (filter (fun d => negb (cell_eqb d base)) (map p (seq 0 N))) = occupants N p c.
  Proof.
    intros p c B; unfold occupants, count. induction (seq 0 N) as [|i l IH]; [reflexivity|]. cbn [map filter].
    destruct (cell_eqb (p i) base) eqn:E; cbn [negb].
    - rewrite IH. destruct (cell_eqb (p i) c) eqn:F; [|reflexivity]. exfalso; apply B.
      apply cell_eqb_spec in E, F; congruence.
    - rewrite times_cons, IH. now destruct (cell_eqb (p i) c).
  Qed.

  (** A marked cell is one, other than the base, that two occupy. *)
  Lemma full_spec : forall p c,
    existsb (cell_eqb c) (marked_full (filter (fun d => negb (cell_eqb d base)) (map p (seq 0 N))) [] []) = true
    <-> c <> base /\ 2 <= occupants N p c.
  Proof.
    intros p c; rewrite existsb_cell, marked_full_spec; cbn [In]. destruct (cell_dec c base) as [->|B].
    - split; [|tauto]. intros [[]|[H|[[] _]]]; exfalso.
      assert (times base (filter (fun d => negb (cell_eqb d base)) (map p (seq 0 N))) = 0); [|lia].
      clear; unfold times. induction (seq 0 N) as [|i l IH]; [reflexivity|]. cbn [map filter].
      destruct (cell_eqb (p i) base) eqn:E; cbn [negb filter]; [exact IH | now rewrite E].
    - rewrite times_occupants by exact B. tauto.
  Qed.

  Hypothesis one_robot : 1 <= N.

  Lemma entry_marked : forall st pl i,
    stays pl (S i) || cell_eqb (planned st pl (S i)) base
      || admits_entry rl (role_of N (S i)) (occupants N (pos st) (planned st pl (S i)))
    = stays pl (S i) || admits_entry rl (role_of N (S i)) 2
      || negb (existsb (cell_eqb (planned st pl (S i)))
        (marked_full (filter (fun c => negb (cell_eqb c base)) (map (pos st) (seq 0 N))) [] [])).
  Proof.
    intros st pl i. destruct (stays pl (S i)); [reflexivity|]. cbn [orb].
    pose proof (full_spec (pos st) (planned st pl (S i))) as F.
    destruct (existsb _ _) eqn:E; cbn [negb].
    - destruct (proj1 F eq_refl) as [B O]. destruct (cell_eqb _ base) eqn:C; [apply cell_eqb_spec in C; contradiction|].
      rewrite orb_false_r; cbn [orb]. unfold admits_entry.
      destruct (Nat.ltb_spec (occupants N (pos st) (planned st pl (S i))) 2); [lia|].
      reflexivity.
    - rewrite orb_true_r. destruct (cell_eqb _ base) eqn:C; [reflexivity|]. cbn [orb]. unfold admits_entry.
      destruct (Nat.ltb_spec (occupants N (pos st) (planned st pl (S i))) 2); [apply orb_true_r|].
      exfalso; assert (false = true); [|discriminate]. apply F; split; [|lia].
      intros X; apply cell_eqb_spec in X; congruence.
  Qed.

  Lemma entries_spec : forall st pl, admits_entries st pl = true <->
    forall i, i < pred N -> stays pl (S i) || cell_eqb (planned st pl (S i)) base
      || admits_entry rl (role_of N (S i)) (occupants N (pos st) (planned st pl (S i))) = true.
  Proof.
    intros st pl; unfold admits_entries. rewrite orb_true_iff, every_spec; split.
    - intros [G|H] i L; rewrite entry_marked; [|now apply H]. apply andb_true_iff in G; destruct G as [G1 G2].
      apply orb_true_iff; left; apply orb_true_iff; right. destruct (role_of N (S i)); assumption.
    - intros H; right; intros i L; rewrite <- entry_marked; now apply H.
  Qed.

  (** The pass finds what the relation says, and known walls. *)
  Theorem admits_plan_spec : forall st pl, pos st 0 = base ->
    (admits_plan st pl = true <-> admitted N rl base st pl = true /\ is_free st pl).
  Proof.
    intros st pl B. unfold admits_plan, admitted. rewrite !andb_true_iff, entries_spec.
    assert (stays pl 0 = true -> planned st pl 0 = base) as Z.
    { intros S0; unfold planned, to, as_move, stays in *; cbn. destruct (pl 0); [discriminate | exact B]. }
    assert (stays pl 0 = true ->
      (negb (distinct rl) || marks_none_twice base [] (map (planned st pl) (seq 1 (pred N))) = true
      <-> every N (fun i => every N (fun j => admits_both rl base st pl i j)) = true)) as D.
    { intros S0; specialize (Z S0). rewrite every_spec. unfold admits_both. destruct (distinct rl); cbn [negb orb].
      - rewrite marking_is_enough by assumption. split.
        + intros H i Li; apply every_spec; intros j Lj. destruct (Nat.eqb_spec i j) as [|U]; [reflexivity|]. cbn [orb].
          destruct (cell_eqb (planned st pl i) (planned st pl j)) eqn:E; [|reflexivity]. cbn [negb orb].
          apply cell_eqb_spec in E; apply cell_eqb_spec; eauto.
        + intros H i j Li Lj U E; specialize (H i Li); rewrite every_spec in H; specialize (H j Lj).
          destruct (Nat.eqb_spec i j); [contradiction|]. cbn [orb] in H. apply cell_eqb_spec in E; rewrite E in H.
          now apply cell_eqb_spec.
      - split; [intros _ i _; apply every_spec; reflexivity | reflexivity]. }
    rewrite !every_spec. unfold admits_robot, admits_pair, is_free. split.
    - intros [[[S0 K] P] E]. split; [split; [split; [split; [exact S0|]|]|]|].
      + intros i L; specialize (P i L); rewrite !andb_true_iff in P; apply P.
      + intros i L; specialize (P i L); rewrite !andb_true_iff in P; cbn [pred]. apply andb_true_iff; split;
          [apply P | now apply E].
      + apply every_spec, D; assumption.
      + intros [|i] L; [unfold is_wall, stays in *; now destruct (pl 0)|].
        specialize (P i ltac:(lia)); rewrite !andb_true_iff in P. now apply negb_true_iff.
    - intros [[[[S0 A] R] K] F]. split; [split; [split; [exact S0|]|]|].
      + apply D; [exact S0|]. now apply every_spec.
      + intros i L. specialize (R i L); apply andb_true_iff in R; cbn [pred] in R. rewrite !andb_true_iff; split;
          [split|].
        * apply negb_true_iff, F; lia.
        * apply R.
        * now apply A.
      + intros i L; specialize (R i L); apply andb_true_iff in R; apply R.
  Qed.
End Admission.

(** CHAIN-4. What is returned of what a planner proposes is admitted and leads over no known wall; or the proposal was
    not so, and all stay. *)
Theorem CHAIN_4 : forall N rl base met st pl, 1 <= N -> pos st 0 = base ->
  (admitted N rl base st (returned N rl base met st pl) = true /\ is_free N met st (returned N rl base met st pl)
    /\ forall i, returned N rl base met st pl i = pl i)
  \/ (~ (admitted N rl base st pl = true /\ is_free N met st pl) /\ forall i, returned N rl base met st pl i = Stay).
Proof.
  intros N rl base met st pl L B; unfold returned. pose proof (admits_plan_spec N rl base met L st pl B) as S.
  destruct (admits_plan N rl base met st pl); [left | right].
  - destruct (proj1 S eq_refl) as [A F]; auto.
  - split; [intros H; apply S in H; discriminate | reflexivity].
Qed.
