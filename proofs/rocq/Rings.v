(** CHAIN-10: a chain of N robots needs at least 9(N-1)-1 team moves to explore (2N-1)^2 cells, whatever it
    does.

    Ring r of the base has 8r cells. By SafeAhead R_i comes at most to ring i-1, so that the leader alone
    explores ring N-1, one cell in a team move, and it needs N-1 team moves to be there at all. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact.
Import ListNotations.
Local Open Scope Z_scope.

(** The ring of a cell: the larger of columns and rows from the base. *)
Definition ring (base c : cell) : Z := Z.max (apart_x base c) (apart_y base c).

(** The cells of ring r, one after the other. *)
Definition on_ring (base : cell) (r j : Z) : cell :=
  if j <? 2 * r then (fst base + j - r, snd base - r)
  else if j <? 4 * r then (fst base + r, snd base + j - 3 * r)
  else if j <? 6 * r then (fst base + 5 * r - j, snd base + r)
  else (fst base - r, snd base + 7 * r - j).

Definition ring_cells (base : cell) (r : nat) : list cell :=
  map (fun j => on_ring base (Z.of_nat r) (Z.of_nat j)) (seq 0 (8 * r)).

Lemma on_ring_injective : forall base r i j, 0 < r -> 0 <= i < 8 * r -> 0 <= j < 8 * r ->
  on_ring base r i = on_ring base r j -> i = j.
Proof.
  intros [bx by_] r i j R I J; unfold on_ring; cbn [fst snd].
  destruct (Z.ltb_spec i (2 * r)), (Z.ltb_spec i (4 * r)), (Z.ltb_spec i (6 * r)),
           (Z.ltb_spec j (2 * r)), (Z.ltb_spec j (4 * r)), (Z.ltb_spec j (6 * r));
    intros E; pose proof (f_equal fst E) as E1; pose proof (f_equal snd E) as E2; cbn [fst snd] in E1, E2; lia.
Qed.

Lemma on_ring_ring : forall base r j, 0 < r -> 0 <= j < 8 * r -> ring base (on_ring base r j) = r.
Proof.
  intros [bx by_] r j R J; unfold on_ring, ring, apart_x, apart_y; cbn [fst snd].
  destruct (Z.ltb_spec j (2 * r)), (Z.ltb_spec j (4 * r)), (Z.ltb_spec j (6 * r)); cbn [fst snd]; lia.
Qed.

Lemma NoDup_map_in : forall (A B : Type) (f : A -> B) l,
  (forall x y, In x l -> In y l -> f x = f y -> x = y) -> NoDup l -> NoDup (map f l).
Proof.
  intros A B f l; induction l as [|a l IH]; intros H N; cbn; constructor; inversion N as [|? ? Na Nl]; subst.
  - rewrite in_map_iff; intros [x [E X]]; apply Na. rewrite (H a x); cbn; auto.
  - apply IH; auto; intros; apply H; cbn; auto.
Qed.

Lemma ring_cells_nodup : forall base r, (0 < r)%nat -> NoDup (ring_cells base r).
Proof.
  intros base r R; apply NoDup_map_in; [|apply seq_NoDup].
  intros i j I J E; apply in_seq in I, J.
  apply on_ring_injective in E; lia.
Qed.

Lemma ring_cells_length : forall base r, length (ring_cells base r) = (8 * r)%nat.
Proof. intros; unfold ring_cells; now rewrite map_length, seq_length. Qed.

Lemma ring_step : forall base c s, ring base (after c s) <= ring base c + 1.
Proof. intros [bx by_] [x y] [[]|]; unfold ring, apart_x, apart_y; cbn; lia. Qed.

Lemma ring_safe : forall base a b, covers SAFE a b = true -> ring base a <= ring base b + 1.
Proof. intros base a b H; apply E_S_is_the_block in H; unfold ring, apart_x, apart_y in *; lia. Qed.

Section Rings.
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable wall : edge -> bool.
  Hypothesis two_robots : (2 <= N)%nat.
  Hypothesis has_safe_ahead : safe_ahead rl = true.

  (** R_i comes at most to ring i-1. *)
  Definition in_rings (p : team) : Prop := forall i, (i < N)%nat -> ring base (p i) <= Z.of_nat i.

  Lemma planned_ring : forall st pl, pos st 0%nat = base -> admitted N rl base st pl = true ->
    forall i, (i < N)%nat -> ring base (planned st pl i) <= Z.of_nat i.
  Proof.
    intros st pl B A i; induction i as [|i IH]; intros L.
    - assert (planned st pl 0 = base) as ->.
      { unfold admitted in A; rewrite !andb_true_iff in A; destruct A as [[[A _] _] _].
        unfold stays in A; unfold planned, to, as_move; cbn; destruct (pl 0%nat); [discriminate | exact B]. }
      unfold ring, apart_x, apart_y; lia.
    - pose proof (admitted_ahead N rl base st pl i A L) as H; unfold admits_ahead in H; rewrite has_safe_ahead in H.
      cbn in H; apply andb_true_iff in H; destruct H as [H _]; apply ring_safe with (base := base) in H.
      specialize (IH ltac:(lia)); unfold planned in *; lia.
  Qed.

  Theorem in_rings_always : forall past st, run N rl base wall past st -> Forall in_rings past.
  Proof.
    intros past st R.
    destruct (composition N rl base wall in_rings (fun _ _ => True)) with (past := past) (st := st)
      as [_ [_ [_ [_ F]]]]; auto; try lia.
    - intros p q S C i L; rewrite <- S by lia; auto.
    - intros i _; unfold ring, apart_x, apart_y; lia.
    - intros s pl K B C A; split; [|exact I]; intros i L.
      destruct (moved_or_not wall s pl i) as [-> | ->]; [|auto]. now apply planned_ring.
    - eapply Forall_impl; [|exact F]. intros p [_ C]; exact C.
  Qed.

  (** After k team moves everybody is at most in ring k. *)
  Theorem ring_by_time : forall past st, run N rl base wall past st ->
    (exists older, past = pos st :: older) /\
    forall i, (i < N)%nat -> ring base (pos st i) <= Z.of_nat (pred (length past)).
  Proof.
    intros past st R; induction R as [st Al|past st pl st' R [[older ->] T] A Al|past st pl rest st' R [[older ->] T] G
      Al];
      (split; [eauto|]); intros i Li; destruct Al as [S _]; rewrite <- (S i Li); cbn.
    - unfold ring, apart_x, apart_y; lia.
    - specialize (T i Li); cbn in T; unfold moved. pose proof (ring_step base (pos st i) (made wall (pos st) pl i));
        lia.
    - specialize (T i Li); cbn in T;
        unfold moved. pose proof (ring_step base (pos st i) (made wall (pos st) (undo pl) i)); lia.
  Qed.

  (** Of the places of the leader, those in the outermost ring are no more than the team moves after the first N-2. *)
  Definition leader (p : team) : cell := p (pred N).
  Definition outer (p : team) : bool := ring base (leader p) =? Z.of_nat (pred N).

  Lemma outer_step : forall past st, run N rl base wall (pos st :: past) st ->
    (length (filter outer past) + (N - 1) <= length past \/ filter outer past = [])%nat ->
    (length (filter outer (pos st :: past)) + (N - 1) <= length (pos st :: past) \/ filter outer (pos st :: past) =
      [])%nat.
  Proof.
    intros past st R IH; apply ring_by_time in R; destruct R as [_ T]; specialize (T (pred N) ltac:(lia));
      cbn [length pred] in T.
    cbn [filter]; destruct (outer (pos st)) eqn:O; cbn [length].
    - left; unfold outer, leader in O; apply Z.eqb_eq in O; destruct IH as [IH|IH]; [lia|rewrite IH; cbn; lia].
    - destruct IH as [IH|IH]; [left; lia | right; exact IH].
  Qed.

  Lemma outer_count : forall past st, run N rl base wall past st ->
    (length (filter outer past) + (N - 1) <= length past \/ filter outer past = [])%nat.
  Proof.
    intros past st R; induction R as [st Al|past st pl st' R IH A Al|past st pl rest st' R IH G Al].
    - right; destruct Al as [S _]; cbn; unfold outer, leader; rewrite <- (S (pred N)) by lia; cbn.
      replace (ring base base) with 0 by (unfold ring, apart_x, apart_y; lia).
      destruct (Z.eqb_spec 0 (Z.of_nat (pred N))); [lia | reflexivity].
    - apply outer_step; [econstructor; eauto | exact IH].
    - apply outer_step; [eapply run_backtrack; eauto | exact IH].
  Qed.

  (** A robot has been in the cell. *)
  Definition explored (past : list team) (c : cell) : Prop := exists p i, In p past /\ (i < N)%nat /\ p i = c.

  Theorem lower_bound : forall past st, run N rl base wall past st ->
    (forall c, ring base c = Z.of_nat (pred N) -> explored past c) ->
    (9 * (N - 1) - 1 <= pred (length past))%nat.
  Proof.
    intros past st R X.
    pose proof (in_rings_always _ _ R) as IR; rewrite Forall_forall in IR.
    assert (incl (ring_cells base (pred N)) (map leader (filter outer past))) as IN.
    { intros c C; unfold ring_cells in C; apply in_map_iff in C; destruct C as [j [<- J]]; apply in_seq in J.
      assert (ring base (on_ring base (Z.of_nat (pred N)) (Z.of_nat j)) = Z.of_nat (pred N)) as Rj
        by (apply on_ring_ring; lia).
      destruct (X _ Rj) as [p [i [P [L E]]]].
      assert (i = pred N) as ->. { specialize (IR p P i L); rewrite E, Rj in IR; lia. }
      apply in_map_iff; exists p; split; [exact E|]. apply filter_In; split; [exact P|].
      unfold outer, leader; rewrite E, Rj; apply Z.eqb_refl. }
    apply NoDup_incl_length in IN; [|apply ring_cells_nodup; lia].
    rewrite ring_cells_length, map_length in IN.
    destruct (outer_count _ _ R) as [O|O]; [lia|]. rewrite O in IN; cbn in IN; lia.
  Qed.
End Rings.

(** [past] holds where the team was after 0, 1, ... team moves: their number is one less. *)
Theorem CHAIN_10 : forall N rl base wall past st,
  (2 <= N)%nat -> safe_ahead rl = true -> run N rl base wall past st ->
  (forall c, ring base c <= Z.of_nat (N - 1) -> explored N past c) ->
  (9 * (N - 1) - 1 <= length past - 1)%nat.
Proof.
  intros N rl base wall past st L H R X.
  rewrite Nat.sub_1_r with (n := length past).
  eapply lower_bound; eauto. intros c E; apply X; lia.
Qed.
