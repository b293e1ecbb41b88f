(** The step of CHAIN-13: unfolding the chain along a walk keeps to the admission relation, and so to CHAIN-1, 2
    and 3.

    For every number of robots, every walk none of whose cells comes twice, and every set of last stops one link
    apart. That the kernel's search for stops returns such a walk, and the argument about the end of a run, are
    not proved here. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact.
Import ListNotations.

(** Whether a follower goes on: [goes_on] of kernel/src/chain/walk.rs, compared with its answers in ChainTie.v. *)
Definition goes_on (own last ahead : nat) : bool := (own <? last) && (own + 2 <=? ahead).

Section Unfolding.
  Variable N : nat.
  Variable base : cell.
  Hypothesis two_robots : 2 <= N.

  (** The cells of the walk, the last one [length]: each beside the next, none twice. *)
  Variable walk : nat -> cell.
  Variable length : nat.
  Hypothesis walk_starts : walk 0 = base.
  Hypothesis walk_steps : forall k, k < length -> exists s, walk (S k) = beyond (walk k) s.
  Hypothesis walk_once : forall j k, j <= length -> k <= length -> walk j = walk k -> j = k.

  (** The last stop of each robot along the walk: 0 for those that stay in the base. One link apart: a cell
      farther, or two round a corner. *)
  Variable last : nat -> nat.
  Hypothesis last_base : last 0 = 0.
  Hypothesis last_leader : last (pred N) <= length.
  Hypothesis last_links : forall i, S i < N ->
    last i <= last (S i) <= S (last i)
    \/ (last (S i) = last i + 2
        /\ (apart_x (walk (last i)) (walk (last i + 2)) <= 1)%Z /\
          (apart_y (walk (last i)) (walk (last i + 2)) <= 1)%Z).

  Lemma last_le : forall i, S i < N -> last i <= last (S i).
  Proof. intros i L; destruct (last_links i L) as [H|[H _]]; lia. Qed.

  Lemma last_length : forall i, i < N -> last i <= length.
  Proof.
    intros i L. assert (forall d, i + d < N -> last i <= last (i + d)) as M.
    { induction d as [|d IH]; intros D; [replace (i + 0) with i by lia; lia|].
      pose proof (last_le (i + d) ltac:(lia)) as H; replace (i + S d) with (S (i + d)) by lia;
        specialize (IH ltac:(lia)); lia. }
    specialize (M (pred N - i) ltac:(lia)); replace (i + (pred N - i)) with (pred N) in M by lia; lia.
  Qed.

  (** Where each robot is along the walk. *)
  Definition on_the_walk (a : nat -> nat) : Prop :=
    a 0 = 0 /\ (forall i, i < N -> a i <= last i)
    /\ forall i, S i < N -> (a i < a (S i) \/ (a i = 0 /\ a (S i) = 0)) /\ (a (S i) <= S (a i) \/ a i = last i).

  (** All begin in the base. *)
  Lemma starts_on_the_walk : on_the_walk (fun _ => 0).
  Proof. split; [|split]; auto; intros i L; lia. Qed.

  (** Where each is planned to be: the leader goes on, a follower where the rule says so. [k] counts from the leader. *)
  Fixpoint planned_from (a : nat -> nat) (k : nat) : nat :=
    let i := pred N - k in
    match k with
    | 0 => if a i <? last i then S (a i) else a i
    | S k => if goes_on (a i) (last i) (planned_from a k) then S (a i) else a i
    end.
  Definition planned_place (a : nat -> nat) (i : nat) : nat := planned_from a (pred N - i).

  Lemma planned_leader : forall a,
    planned_place a (pred N) = if a (pred N) <? last (pred N) then S (a (pred N)) else a (pred N).
  Proof. intros a; unfold planned_place; rewrite Nat.sub_diag; cbn; now rewrite Nat.sub_0_r. Qed.

  Lemma planned_follower : forall a i, S i < N ->
    planned_place a i = if goes_on (a i) (last i) (planned_place a (S i)) then S (a i) else a i.
  Proof.
    intros a i L; unfold planned_place. replace (pred N - i) with (S (pred N - S i)) by lia. cbn [planned_from].
    replace (pred N - S (pred N - S i)) with i by lia. reflexivity.
  Qed.

  Lemma planned_bounds : forall a i, i < N -> on_the_walk a ->
    a i <= planned_place a i <= S (a i) /\ planned_place a i <= last i.
  Proof.
    intros a i L [_ [B _]]; specialize (B i L). destruct (Nat.eq_dec (S i) N) as [E|E].
    - assert (i = pred N) as -> by lia. rewrite planned_leader.
      destruct (Nat.ltb_spec (a (pred N)) (last (pred N))); lia.
    - rewrite planned_follower by lia; unfold goes_on.
      destruct (Nat.ltb_spec (a i) (last i)), (Nat.leb_spec (a i + 2) (planned_place a (S i))); cbn; lia.
  Qed.

  (** Places planned are again places on the walk: kept, if no wall is met. *)
  Lemma on_the_walk_kept : forall a, on_the_walk a -> on_the_walk (planned_place a).
  Proof.
    intros a O; split; [|split].
    - destruct (planned_bounds a 0 ltac:(lia) O) as [_ H]; rewrite last_base in H; lia.
    - intros i L; now apply planned_bounds.
    - intros i L; pose proof (planned_bounds a i ltac:(lia) O) as Bi; pose proof (planned_bounds a (S i) L O) as Bj.
      destruct O as [A0 [B P]]; destruct (P i L) as [G H]; pose proof (B i ltac:(lia)) as Li;
        pose proof (B (S i) L) as Lj.
      pose proof (last_links i L) as K.
      rewrite (planned_follower a i L) in *; unfold goes_on in *.
      destruct (Nat.ltb_spec (a i) (last i)), (Nat.leb_spec (a i + 2) (planned_place a (S i))); cbn in *; lia.
  Qed.

  Lemma places_grow : forall a, on_the_walk a -> forall i j, i < j -> j < N -> a i < a j \/ (a i = 0 /\ a j = 0).
  Proof.
    intros a [A0 [B P]] i j L; induction L as [|j L IH]; intros M; [now apply P|].
    destruct (IH ltac:(lia)), (P j M) as [[?|?] _]; lia.
  Qed.

  (** The plan as steps, the base staying: each from the cell where it is to the cell of its planned place. *)
  Definition follows (a : nat -> nat) (st : state) (pl : plan) : Prop :=
    forall i, i < N -> pos st i = walk (a i) /\ after (pos st i) (pl i) = walk (planned_place a i).

  Lemma near_one : forall c s, (apart_x c (beyond c s) <= 1 /\ apart_y c (beyond c s) <= 1)%Z /\
    (apart_x c (beyond c s) + apart_y c (beyond c s) = 1)%Z.
  Proof. intros [x y] []; unfold apart_x, apart_y; cbn; lia. Qed.

  Lemma walk_next : forall k, k < length -> covers SAFE (walk k) (walk (S k)) = true.
  Proof.
    intros k L; destruct (walk_steps k L) as [s E]; rewrite E; apply E_S_is_the_block; now apply near_one.
  Qed.

  (** Two cells on the walk at most two apart, and the second beside a corner of the first or straight ahead: E_C. *)
  Lemma walk_two : forall k, S k < length -> covers COVERED (walk k) (walk (S (S k))) = true.
  Proof.
    intros k L; destruct (walk_steps k ltac:(lia)) as [s E]; destruct (walk_steps (S k) L) as [t F].
    rewrite F, E; apply E_C_is_the_block_and_four.
    destruct (walk k) as [x y]; destruct s, t; unfold apart_x, apart_y; cbn; lia.
  Qed.

  Lemma stays_if_same : forall c s, after c s = c -> s = Stay.
  Proof. intros c [s|] E; [exfalso; revert E; apply after_cross | reflexivity]. Qed.

  Lemma unfolding_is_admitted : forall a st pl, on_the_walk a -> follows a st pl -> pos st 0 = base ->
    admitted N REPAIRED base st pl = true.
  Proof.
    intros a st pl O F P0; pose proof (on_the_walk_kept a O) as O'.
    assert (forall i, i < N -> planned st pl i = walk (planned_place a i)) as PL by (intros i L; apply F; exact L).
    assert (forall i, i < N -> pos st i = walk (a i)) as PO by (intros i L; apply F; exact L).
    unfold admitted; rewrite !andb_true_iff; repeat split.
    - destruct (F 0 ltac:(lia)) as [A B]. destruct (planned_bounds a 0 ltac:(lia) O) as [_ H]; rewrite last_base in H.
      unfold stays; replace (pl 0) with Stay; [reflexivity|]. symmetry; apply (stays_if_same (pos st 0)).
      rewrite B, P0. replace (planned_place a 0) with 0 by lia. exact walk_starts.
    - apply every_spec; intros i L. assert (S i < N) as Li by lia.
      unfold admits_ahead, to, as_move; cbn. fold (as_move st pl i).
      change (after (pos st i) (pl i)) with (planned st pl i);
        change (after (pos st (S i)) (pl (S i))) with (planned st pl (S i)).
      rewrite (PL i), (PL (S i)), (PO (S i)) by lia.
      destruct (planned_bounds a i ltac:(lia) O) as [Bi Ci]; destruct (planned_bounds a (S i) Li O) as [Bj Cj].
      destruct O as [A0 [B P]]; destruct (P i Li) as [G H]; pose proof (last_links i Li) as K;
        pose proof (B i ltac:(lia)) as Di.
      pose proof (last_length (S i) Li) as LL.
      pose proof (planned_follower a i Li) as Q; unfold goes_on in Q.
      assert (planned_place a (S i) = planned_place a i \/ planned_place a (S i) = S (planned_place a i)
              \/ (planned_place a i = last i /\ planned_place a (S i) = last i + 2 /\ last (S i) = last i + 2)) as D.
      { destruct (Nat.ltb_spec (a i) (last i)), (Nat.leb_spec (a i + 2) (planned_place a (S i))); cbn in Q; lia. }
      assert (planned_place a i = a (S i) \/ S (planned_place a i) = a (S i) \/ planned_place a i = S (a (S i))
              \/ (planned_place a i = last i /\ a (S i) = last i + 2 /\ last (S i) = last i + 2)) as U.
      { destruct (Nat.ltb_spec (a i) (last i)), (Nat.leb_spec (a i + 2) (planned_place a (S i))); cbn in Q; lia. }
      apply andb_true_iff; split.
      + destruct D as [D|[D|[D1 [D2 M]]]].
        * rewrite D; apply covers_self; unfold SAFE; lia.
        * rewrite D, covers_sym; apply walk_next; lia.
        * rewrite D1, D2. destruct K as [K|[_ [X Y]]]; [lia|]. rewrite covers_sym; now apply E_S_is_the_block.
      + apply orb_true_iff; right. apply covers_mono with (r := SAFE); [unfold SAFE, COVERED; lia|].
        destruct U as [U|[U|[U|[U1 [U2 M]]]]].
        * rewrite U; apply covers_self; unfold SAFE; lia.
        * rewrite <- U, covers_sym; apply walk_next; lia.
        * rewrite U; apply walk_next; lia.
        * rewrite U1, U2. destruct K as [K|[_ [X Y]]]; [lia|]. rewrite covers_sym; now apply E_S_is_the_block.
    - apply every_spec; intros i L. assert (S i < N) as Li by lia. unfold admits_robot; apply andb_true_iff.
      destruct (planned_bounds a i ltac:(lia) O) as [Bi Ci]; destruct (planned_bounds a (S i) Li O) as [Bj Cj].
      pose proof (last_length (S i) Li) as LL. cbn [pred].
      split.
      + apply orb_true_iff; right; unfold admits_behind; cbn. rewrite (PL (S i)), (PO i) by lia.
        pose proof (last_links i Li) as K.
        destruct O as [A0 [B P]]; destruct (P i Li) as [G H]; pose proof (B i ltac:(lia)) as Di.
        assert (planned_place a (S i) = a i \/ planned_place a (S i) = S (a i)
                \/ planned_place a (S i) = S (S (a i))) as D by lia.
        destruct D as [D|[D|D]]; rewrite D.
        * apply covers_self; unfold COVERED; lia.
        * apply covers_mono with (r := SAFE); [unfold SAFE, COVERED; lia|]. apply walk_next; lia.
        * apply walk_two; lia.
      + destruct (stays pl (S i)) eqn:ST; [reflexivity|]. cbn.
        apply orb_true_iff; right. unfold admits_entry.
        assert (occupants N (pos st) (planned st pl (S i)) < 2) as OC.
        { (* places outside the base are one to a robot, and who goes on leaves the base *)
          destruct (Nat.ltb_spec (occupants N (pos st) (planned st pl (S i))) 2) as [|TWO]; [assumption|exfalso].
          unfold occupants, count in TWO.
          set (f := fun j => cell_eqb (pos st j) (planned st pl (S i))) in *.
          assert (NoDup (filter f (seq 0 N))) as ND by (apply NoDup_filter, seq_NoDup).
          assert (forall j, In j (filter f (seq 0 N)) -> j < N /\ a j = planned_place a (S i)) as IN.
          { intros j J; apply filter_In in J; destruct J as [J E]; apply in_seq in J; split; [lia|].
            unfold f in E; apply cell_eqb_spec in E. rewrite PO, PL in E by lia.
            apply walk_once in E; auto; [|lia]. destruct O as [_ [B _]]; pose proof (B j ltac:(lia));
              pose proof (last_length j ltac:(lia)); lia. }
          assert (0 < planned_place a (S i)) as POS.
          { destruct (Nat.eq_dec (planned_place a (S i)) (a (S i))) as [E|E]; [|lia]. exfalso.
            assert (pl (S i) = Stay) as X.
            { apply (stays_if_same (pos st (S i))). destruct (F (S i) Li) as [F1 F2]. now rewrite F2, E. }
            unfold stays in ST; rewrite X in ST; discriminate. }
          destruct (filter f (seq 0 N)) as [|j [|k rest]]; cbn in TWO; try lia.
          destruct (IN j) as [Lj Ej]; [cbn; auto|]. destruct (IN k) as [Lk Ek]; [cbn; auto|].
          inversion ND as [|? ? N1 _]; subst.
          assert (j <> k) as JK by (intros ->; apply N1; cbn; auto).
          destruct (Nat.lt_total j k) as [C|[C|C]]; [|contradiction|].
          - destruct (places_grow a O j k C Lk); lia.
          - destruct (places_grow a O k j C Lj); lia. }
        destruct (role_of N (S i)); cbn [full_for_leader full_for_follower REPAIRED negb orb]; now apply Nat.ltb_lt.
    - apply every_spec; intros i Li; apply every_spec; intros j Lj. unfold admits_both;
        cbn [distinct REPAIRED negb orb].
      destruct (Nat.eqb_spec i j) as [|D]; [reflexivity|]. cbn [orb].
      destruct (cell_eqb (planned st pl i) (planned st pl j)) eqn:E; [|reflexivity]. cbn.
      apply cell_eqb_spec in E; rewrite !PL in E by lia.
      pose proof (planned_bounds a i Li O) as [Bi Ci]; pose proof (planned_bounds a j Lj O) as [Bj Cj].
      pose proof (last_length i Li); pose proof (last_length j Lj).
      apply walk_once in E; try lia. apply cell_eqb_spec. rewrite PL by lia.
      assert (planned_place a i = 0) as Z.
      { destruct (Nat.lt_total i j) as [C|[C|C]]; [|contradiction|].
        - destruct (places_grow _ O' i j C Lj); lia.
        - destruct (places_grow _ O' j i C Li); lia. }
      rewrite Z; exact walk_starts.
  Qed.
End Unfolding.

(** A walk from the base: each cell beside the next, none twice, the last one [length]. *)
Record is_walk (base : cell) (walk : nat -> cell) (length : nat) : Prop := {
  walk_begins : walk 0 = base;
  walk_goes : forall k, k < length -> exists s, walk (S k) = beyond (walk k) s;
  walk_comes_once : forall j k, j <= length -> k <= length -> walk j = walk k -> j = k;
}.

(** Where robots stop along it, the base in the base: each at most one link farther than the robot behind it,
    that is one cell, or two round a corner. *)
Record are_stops (N : nat) (walk : nat -> cell) (length : nat) (last : nat -> nat) : Prop := {
  stops_begin : last 0 = 0;
  stops_end : last (pred N) <= length;
  stops_link : forall i, S i < N ->
    last i <= last (S i) <= S (last i)
    \/ (last (S i) = last i + 2
        /\ (apart_x (walk (last i)) (walk (last i + 2)%nat) <= 1)%Z /\
          (apart_y (walk (last i)) (walk (last i + 2)%nat) <= 1)%Z);
}.

(** In the base all robots are on the walk. If they are on it, the plan that unfolds the chain further is
    admitted, and they are on it again where that plan sends them. *)
Theorem CHAIN_13_step : forall N base walk length last,
  2 <= N -> is_walk base walk length -> are_stops N walk length last ->
  on_the_walk N last (fun _ => 0)
  /\ forall a, on_the_walk N last a ->
     on_the_walk N last (planned_place N last a)
     /\ forall st pl, follows N walk last a st pl -> pos st 0 = base -> admitted N REPAIRED base st pl = true.
Proof.
  intros N base walk length last L [W1 W2 W3] [S1 S2 S3]; split; [apply starts_on_the_walk with (length := length);
    assumption|].
  intros a O; split; [eapply on_the_walk_kept with (walk := walk) (length := length); eauto|].
  intros st pl F B; apply unfolding_is_admitted with (walk := walk) (length := length) (last := last) (a := a);
    assumption.
Qed.
