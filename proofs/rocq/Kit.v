(** KIT-1, KIT-3 and KIT-12: robots that keep in touch on a lattice after [Peiris], for every number of robots,
    every map and every run.

    A robot stands at a node or drives from one to a neighbour. The team starts connected, at different nodes.
    One robot at a time decides, as Turn demands, and knows where the others are, as KIT-5 says. It may drive
    through any side that the conditions admit, whatever it prefers and whatever it sees there, or stay.
    Arrivals come at any time, also between a decision and the drive. So walls, records, the joint way and the
    messages play no part. The unit is the path between two nodes, 3 m. *)
From Coq Require Import ZArith QArith Lia Lqa Bool List Arith.
From Tautline Require Import Lattice Plane.
Import ListNotations.
Local Open Scope nat_scope.

Inductive stance := Stands (at_ : cell) | Drives (from_ : cell) (s : side).

(** The node that a robot has left last and the one where it will be next; where it stands, both are its node. *)
Definition left_ (x : stance) : cell := match x with Stands c => c | Drives c _ => c end.
Definition next (x : stance) : cell := match x with Stands c => c | Drives c s => beyond c s end.

(** In reach: dx^2 + dy^2 <= 11, that is at most 10 m apart. *)
Definition in_reach (a b : cell) : bool :=
  ((fst a - fst b) * (fst a - fst b) + (snd a - snd b) * (snd a - snd b) <=? 11)%Z.

(** Contact: all four corners are in reach. *)
Definition is_sure_of (x y : stance) : bool :=
  in_reach (left_ x) (left_ y) && in_reach (left_ x) (next y) && in_reach (next x) (left_ y) && in_reach (next x) (next
    y).

Definition has (x : stance) (c : cell) : bool := cell_eqb (left_ x) c || cell_eqb (next x) c.

(** Whether two paths have no end in common. *)
Definition is_apart_from (x y : stance) : bool := negb (has y (left_ x)) && negb (has y (next x)).

(** Where each robot is. *)
Definition team := nat -> stance.
Definition put (t : team) (i : nat) (x : stance) : team := fun j => if j =? i then x else t j.

Section Robots.
  Variable N : nat.

  (** Robots that are in contact, directly or over others. *)
  Inductive touch (t : team) : nat -> nat -> Prop :=
  | touch_self : forall i, i < N -> touch t i i
  | touch_over : forall i j k, i < N -> j < N -> is_sure_of (t i) (t j) = true -> touch t j k -> touch t i k.

  Definition connected (t : team) : Prop := forall i j, i < N -> j < N -> touch t i j.
  Definition apart (t : team) : Prop := forall i j, i < N -> j < N -> i <> j -> is_apart_from (t i) (t j) = true.

  (** The drives that NextInReach, FromInReach and Apart admit: to no end of another one's path, and so that the
      team stays connected. *)
  Definition admits (t : team) (i : nat) (s : side) : Prop :=
    (forall j, j < N -> j <> i -> has (t j) (next (Drives (left_ (t i)) s)) = false)
    /\ connected (put t i (Drives (left_ (t i)) s)).

  Inductive run : team -> Prop :=
  | run_start : forall t, (forall i, i < N -> exists c, t i = Stands c) -> connected t -> apart t -> run t
  | run_drive : forall t i s c, run t -> i < N -> t i = Stands c -> admits t i s -> run (put t i (Drives c s))
  | run_arrive : forall t i c s, run t -> i < N -> t i = Drives c s -> run (put t i (Stands (beyond c s))).

  Lemma put_same : forall t i x, put t i x i = x.
  Proof. intros; unfold put; now rewrite Nat.eqb_refl. Qed.
  Lemma put_other : forall t i x j, j <> i -> put t i x j = t j.
  Proof. intros t i x j D; unfold put; apply Nat.eqb_neq in D; now rewrite D. Qed.

  (** Who arrives has two of the corners left. *)
  Lemma arrive_sure : forall c s y, is_sure_of (Drives c s) y = true -> is_sure_of (Stands (beyond c s)) y = true.
  Proof. intros c s y; unfold is_sure_of; cbn; rewrite !andb_true_iff; intuition. Qed.
  Lemma arrive_sure_back : forall c s y, is_sure_of y (Drives c s) = true -> is_sure_of y (Stands (beyond c s)) = true.
  Proof. intros c s y; unfold is_sure_of; cbn; rewrite !andb_true_iff; intuition. Qed.
  Lemma arrive_sure_self : forall c, is_sure_of (Stands c) (Stands c) = true.
  Proof. intros c; unfold is_sure_of, in_reach; cbn; rewrite !Z.sub_diag; reflexivity. Qed.

  Lemma touch_arrive : forall t i c s j k, t i = Drives c s -> touch t j k -> touch (put t i (Stands (beyond c s))) j k.
  Proof.
    intros t i c s j k D T; induction T as [j L | j k l Lj Lk A T IH]; [now constructor|].
    apply touch_over with (j := k); auto.
    destruct (Nat.eq_dec j i) as [->|J], (Nat.eq_dec k i) as [->|K]; rewrite ?put_same, ?put_other by assumption.
    - apply arrive_sure_self.
    - rewrite D in A; now apply arrive_sure.
    - rewrite D in A; now apply arrive_sure_back.
    - exact A.
  Qed.

  Lemma connected_always : forall t, run t -> connected t.
  Proof.
    intros t R; induction R as [t S C A | t i s c R IH L E A | t i c s R IH L E]; [exact C | |].
    - destruct A as [_ A]; rewrite E in A; exact A.
    - intros j k Lj Lk; apply touch_arrive; auto.
  Qed.

  Lemma apart_sym : forall x y, is_apart_from x y = true -> is_apart_from y x = true.
  Proof.
    assert (forall a b, cell_eqb a b = cell_eqb b a) as S.
    { intros a b; unfold cell_eqb; now rewrite (Z.eqb_sym (fst a)), (Z.eqb_sym (snd a)). }
    intros x y; unfold is_apart_from, has; rewrite (S (left_ y) (left_ x)), (S (left_ y) (next x)),
      (S (next y) (left_ x)), (S (next y) (next x)).
    destruct (cell_eqb (left_ x) (left_ y)), (cell_eqb (next x) (left_ y)), (cell_eqb (left_ x) (next y)),
      (cell_eqb (next x) (next y)); auto.
  Qed.

  Lemma apart_put : forall t i x, apart t -> (forall j, j < N -> j <> i -> is_apart_from x (t j) = true) ->
    apart (put t i x).
  Proof.
    intros t i x A H j k Lj Lk D.
    destruct (Nat.eq_dec j i) as [->|J], (Nat.eq_dec k i) as [->|K]; rewrite ?put_same, ?put_other by assumption.
    - contradiction.
    - now apply H.
    - apply apart_sym; now apply H.
    - now apply A.
  Qed.

  Lemma apart_always : forall t, run t -> apart t.
  Proof.
    intros t R; induction R as [t S C A | t i s c R IH L E A | t i c s R IH L E]; [exact A | |]; apply apart_put; auto;
      intros j Lj D; specialize (IH i j L Lj (not_eq_sym D)); rewrite E in IH; unfold is_apart_from in *; cbn in *;
      apply andb_true_iff in IH; destruct IH as [I1 I2].
    - destruct A as [A _]; specialize (A j Lj D); rewrite E in A; cbn in A. now rewrite I1, A.
    - now rewrite I2.
  Qed.
End Robots.

(** An arrival leaves admitted what was admitted before: a robot may decide first and look at the side then. *)
Lemma touch_same : forall N t u i j, (forall k, t k = u k) -> touch N t i j -> touch N u i j.
Proof.
  intros N t u i j E T; induction T as [i L | i j k Li Lj S T IH]; [now apply touch_self|].
  apply touch_over with (j := j); auto. now rewrite <- !E.
Qed.

Theorem arrivals_keep_admitted : forall N t i s j c s', admits N t i s -> j < N -> j <> i -> t j = Drives c s' ->
  admits N (put t j (Stands (beyond c s'))) i s.
Proof.
  intros N t i s j c s' [A C] L D E; split.
  - intros k Lk Dk; rewrite (put_other t j _ i) by congruence; specialize (A k Lk Dk).
    destruct (Nat.eq_dec k j) as [->|K]; [|now rewrite put_other].
    rewrite put_same, E in *; unfold has in *; cbn in *; apply orb_false_iff in A; destruct A as [_ A]; now rewrite A.
  - rewrite (put_other t j _ i) by congruence. set (path := Drives (left_ (t i)) s) in *.
    intros k l Lk Ll; apply touch_same with (t := put (put t i path) j (Stands (beyond c s'))).
    + intros m; unfold put; destruct (Nat.eqb_spec m j), (Nat.eqb_spec m i); subst; auto; contradiction.
    + apply touch_arrive; [|now apply C]. now rewrite put_other.
Qed.

(** ** Distances. Where a robot is: some part of its path. *)
Definition whereabouts (x : stance) (part : Q) : point := between part (centre (left_ x)) (centre (next x)).

Lemma in_reach_norm2 : forall a b, in_reach a b = true -> (norm2 (minus (centre a) (centre b)) <= 11 # 1)%Q.
Proof. intros a b; unfold in_reach; rewrite Z.leb_le; intros H; apply norm2_centres; lia. Qed.

Lemma sure_distance : forall x y s t, is_sure_of x y = true -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (norm2 (minus (whereabouts x s) (whereabouts y t)) <= 11 # 1)%Q.
Proof.
  intros x y s t C S T; unfold is_sure_of in C; rewrite !andb_true_iff in C; destruct C as [[[A B] D] E].
  apply corners_decide; auto; now apply in_reach_norm2.
Qed.

(** A number somewhere between two whole ones. *)
Lemma between_whole : forall (a b : Z) (t : Q), (0 <= t <= 1)%Q ->
  (inject_Z (Z.min a b) <= (1 - t) * inject_Z a + t * inject_Z b <= inject_Z (Z.max a b))%Q.
Proof.
  intros a b t [T0 T1].
  assert (inject_Z (Z.min a b) <= inject_Z a)%Q by (rewrite <- Zle_Qle; lia).
  assert (inject_Z (Z.min a b) <= inject_Z b)%Q by (rewrite <- Zle_Qle; lia).
  assert (inject_Z a <= inject_Z (Z.max a b))%Q by (rewrite <- Zle_Qle; lia).
  assert (inject_Z b <= inject_Z (Z.max a b))%Q by (rewrite <- Zle_Qle; lia).
  set (p := inject_Z a) in *; set (q := inject_Z b) in *.
  set (l := inject_Z (Z.min a b)) in *; set (h := inject_Z (Z.max a b)) in *; clearbody p q l h.
  assert (0 <= 1 - t)%Q as U by lra.
  assert ((1 - t) * l <= (1 - t) * p)%Q by (rewrite !(Qmult_comm (1 - t)); apply Qmult_le_compat_r; assumption).
  assert (t * l <= t * q)%Q by (rewrite !(Qmult_comm t); apply Qmult_le_compat_r; assumption).
  assert ((1 - t) * p <= (1 - t) * h)%Q by (rewrite !(Qmult_comm (1 - t)); apply Qmult_le_compat_r; assumption).
  assert (t * q <= t * h)%Q by (rewrite !(Qmult_comm t); apply Qmult_le_compat_r; assumption).
  lra.
Qed.

(** Two paths without a common end are separated by a whole path, in columns or in rows. *)
Lemma apart_separated : forall x y, is_apart_from x y = true ->
  (Z.max (fst (left_ x)) (fst (next x)) + 1 <= Z.min (fst (left_ y)) (fst (next y))
   \/ Z.max (fst (left_ y)) (fst (next y)) + 1 <= Z.min (fst (left_ x)) (fst (next x))
   \/ Z.max (snd (left_ x)) (snd (next x)) + 1 <= Z.min (snd (left_ y)) (snd (next y))
   \/ Z.max (snd (left_ y)) (snd (next y)) + 1 <= Z.min (snd (left_ x)) (snd (next x)))%Z.
Proof.
  assert (forall a b, cell_eqb a b = false -> (fst a <> fst b \/ snd a <> snd b)%Z) as NE.
  { intros [a1 a2] [b1 b2]; unfold cell_eqb; cbn [fst snd]; rewrite andb_false_iff, !Z.eqb_neq; auto. }
  intros x y H; unfold is_apart_from, has in H; rewrite andb_true_iff, !negb_true_iff, !orb_false_iff in H.
  destruct H as [[A B] [C D]]; apply NE in A, B, C, D.
  destruct x as [[a b]|[a b] []], y as [[c d]|[c d] []]; unfold left_, next, beyond in *; cbn [fst snd offset] in *;
    lia.
Qed.

Lemma apart_distance : forall x y s t, is_apart_from x y = true -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (1 <= norm2 (minus (whereabouts x s) (whereabouts y t)))%Q.
Proof.
  intros x y s t A S T; apply apart_separated in A.
  assert (forall u v : Q, 1 <= u * u -> 1 <= u * u + v * v)%Q as L by (intros u v H; pose proof (square_le v); lra).
  assert (forall u v : Q, 1 <= v * v -> 1 <= u * u + v * v)%Q as R by (intros u v H; pose proof (square_le u); lra).
  assert (forall u : Q, 1 <= u \/ u <= -1 -> 1 <= u * u)%Q as G.
  { intros u [H|H].
    - setoid_replace (u * u)%Q with ((u - 1) * (u - 1) + 2 * (u - 1) + 1)%Q by ring. pose proof (square_le (u - 1));
        lra.
    - setoid_replace (u * u)%Q with ((u + 1) * (u + 1) + 2 * (-1 - u) + 1)%Q by ring. pose proof (square_le (u + 1));
        lra. }
  unfold whereabouts, norm2, minus, between, centre; cbn [fst snd].
  pose proof (between_whole (fst (left_ x)) (fst (next x)) s S);
    pose proof (between_whole (fst (left_ y)) (fst (next y)) t T).
  pose proof (between_whole (snd (left_ x)) (snd (next x)) s S);
    pose proof (between_whole (snd (left_ y)) (snd (next y)) t T).
  destruct A as [A|[A|[A|A]]]; rewrite Zle_Qle, inject_Z_plus in A; change (inject_Z 1) with 1%Q in A;
    [apply L | apply L | apply R | apply R]; apply G; lra.
Qed.

Lemma in_reach_sym : forall a b, in_reach a b = in_reach b a.
Proof. intros a b; unfold in_reach; f_equal; ring. Qed.

Lemma is_sure_of_sym : forall x y, is_sure_of x y = is_sure_of y x.
Proof.
  intros x y; unfold is_sure_of.
  rewrite (in_reach_sym (left_ x)), (in_reach_sym (left_ x) (next y)), (in_reach_sym (next x)),
    (in_reach_sym (next x) (next y)).
  destruct (in_reach (left_ y) (left_ x)), (in_reach (next y) (left_ x)), (in_reach (left_ y) (next x)),
    (in_reach (next y) (next x)); reflexivity.
Qed.

Lemma connected_two : forall t, connected 2 t <-> is_sure_of (t 0) (t 1) = true.
Proof.
  intros t; split.
  - intros C; specialize (C 0 1 ltac:(lia) ltac:(lia)).
    assert (forall i k, touch 2 t i k -> i = 0 -> k = 1 -> is_sure_of (t 0) (t 1) = true) as G.
    { intros i k X; induction X as [i L | i j k L Lj S X IH]; intros E F; [lia|]. subst i k.
      destruct j as [|[|j]]; [now apply IH | exact S | lia]. }
    now apply (G 0 1).
  - intros S [|[|i]] [|[|j]] Li Lj; try lia; try (apply touch_self; lia).
    + apply touch_over with (j := 1); auto. apply touch_self; lia.
    + apply touch_over with (j := 0); auto; [now rewrite is_sure_of_sym | apply touch_self; lia].
Qed.

(** ** The clauses. *)

(** Robots that hear each other directly or over others when they start do so all the time. *)
Theorem KIT_12 : forall N t, run N t -> connected N t.
Proof. intros N t R; now apply connected_always. Qed.

(** Two robots hear each other all the time: whatever parts of their paths they have driven, they are at most 10
    m apart, paths being 3 m. *)
Theorem KIT_1 : forall t, run 2 t ->
  is_sure_of (t 0) (t 1) = true
  /\ forall part part', (0 <= part <= 1)%Q -> (0 <= part' <= 1)%Q ->
     (3 * 3 * norm2 (minus (whereabouts (t 0%nat) part) (whereabouts (t 1%nat) part')) <= 10 * 10)%Q.
Proof.
  intros t R; pose proof (proj1 (connected_two t) (KIT_12 2 t R)) as S.
  split; [exact S|]. intros part part' P P'; pose proof (sure_distance _ _ _ _ S P P') as D.
  set (d := norm2 _) in *; clearbody d. lra.
Qed.

(** Robots are never nearer to each other than 3 m, the length of a path, if they start at different nodes. *)
Theorem KIT_3 : forall N t, run N t -> forall i j, i < N -> j < N -> i <> j ->
  is_apart_from (t i) (t j) = true
  /\ forall part part', (0 <= part <= 1)%Q -> (0 <= part' <= 1)%Q ->
     (1 <= norm2 (minus (whereabouts (t i) part) (whereabouts (t j) part')))%Q.
Proof.
  intros N t R i j Li Lj D; pose proof (apart_always N t R i j Li Lj D) as A; split; [exact A|].
  intros; now apply apart_distance.
Qed.

(** ** Two robots. Which drives some of the conditions admit, as a function that computes: [i] drives, [j] is
    the other robot. *)
Record rule := { next_in_reach : bool; from_in_reach : bool; apart_ : bool }.

Definition REPAIRED : rule := Build_rule true true true.
Definition without_NextInReach : rule := Build_rule false true true.
Definition without_FromInReach : rule := Build_rule true false true.
Definition without_Apart : rule := Build_rule true true false.

Definition admits_two (rl : rule) (own other : stance) (s : side) : bool :=
  let path := Drives (left_ own) s in
  (negb (next_in_reach rl) || in_reach (next path) (next other))
  && (negb (from_in_reach rl) || (in_reach (left_ path) (next other) && in_reach (next path) (left_ other)
                                  && in_reach (left_ path) (left_ other)))
  && (negb (apart_ rl) || negb (has other (next path))).

(** With all conditions it is the relation that the theorems speak of. *)
Lemma admits_two_is_admits : forall t i s, i < 2 ->
  admits 2 t i s <-> admits_two REPAIRED (t i) (t (1 - i)) s = true.
Proof.
  assert (forall x y s, is_sure_of (Drives (left_ x) s) y && negb (has y (next (Drives (left_ x) s)))
            = admits_two REPAIRED x y s) as E.
  { intros x y s; unfold is_sure_of, admits_two; cbn [next_in_reach from_in_reach apart_ REPAIRED negb orb].
    destruct (in_reach _ (left_ y)), (in_reach _ (next y)), (in_reach _ (left_ y)), (in_reach _ (next y)), (has _ _);
      reflexivity. }
  intros t i s L; rewrite <- E, andb_true_iff, negb_true_iff; unfold admits; rewrite connected_two.
  destruct i as [|[|i]]; [| |lia]; cbn [Nat.sub]; rewrite put_same, put_other by lia.
  - split; [intros [A C]; split; [exact C | apply A; lia]|]. intros [C A]; split; [|exact C].
    intros [|[|j]] Lj D; [lia | exact A | lia].
  - rewrite (is_sure_of_sym (t 0)). split; [intros [A C]; split; [exact C | apply A; lia]|]. intros [C A]; split;
      [|exact C].
    intros [|[|j]] Lj D; [exact A | lia | lia].
Qed.

(** ** Each condition is needed: runs of two robots by a rule without it. *)
Inductive run_by (rl : rule) : team -> Prop :=
| by_start : forall t, (forall i, i < 2 -> exists c, t i = Stands c) -> connected 2 t -> apart 2 t -> run_by rl t
| by_drive : forall t i s c, run_by rl t -> i < 2 -> t i = Stands c -> admits_two rl (t i) (t (1 - i)) s = true ->
    run_by rl (put t i (Drives c s))
| by_arrive : forall t i c s, run_by rl t -> i < 2 -> t i = Drives c s -> run_by rl (put t i (Stands (beyond c s))).

Definition standing (a b : cell) : team := fun i => match i with 0 => Stands a | _ => Stands b end.

Lemma by_standing : forall rl a b, in_reach a b = true -> cell_eqb a b = false -> run_by rl (standing a b).
Proof.
  intros rl a b R D; apply by_start.
  - intros [|i] _; eexists; reflexivity.
  - apply connected_two; unfold is_sure_of; cbn; now rewrite R.
  - assert (is_apart_from (Stands a) (Stands b) = true) as A.
    { unfold is_apart_from, has; cbn. replace (cell_eqb b a) with false; [reflexivity|].
      symmetry; unfold cell_eqb in *; now rewrite (Z.eqb_sym (fst b)), (Z.eqb_sym (snd b)). }
    intros [|[|i]] [|[|j]] Li Lj N; try lia; [exact A | now apply apart_sym].
Qed.

(** The other robot is told where a robot goes, and not where it is: two drives. *)
Theorem without_FromInReach_breaks_KIT_1 : exists t, run_by without_FromInReach t /\ is_sure_of (t 0) (t 1) = false.
Proof.
  exists (put (put (standing (0, 0) (3, 1)) 0 (Drives (0, 0) South)) 1 (Drives (3, 1) South))%Z; split; [|reflexivity].
  apply by_drive; [|lia|reflexivity|reflexivity]. apply by_drive; [|lia|reflexivity|reflexivity]. now apply by_standing.
Qed.

Theorem without_NextInReach_breaks_KIT_1 : exists t, run_by without_NextInReach t /\ is_sure_of (t 0) (t 1) = false.
Proof.
  exists (put (put (standing (0, 0) (3, 0)) 1 (Drives (3, 0) South)) 0 (Drives (0, 0) North))%Z; split; [|reflexivity].
  apply by_drive; [|lia|reflexivity|reflexivity]. apply by_drive; [|lia|reflexivity|reflexivity]. now apply by_standing.
Qed.

Theorem without_Apart_breaks_KIT_3 : exists t, run_by without_Apart t /\ is_apart_from (t 0) (t 1) = false.
Proof.
  exists (put (standing (0, 0) (1, 0)) 0 (Drives (0, 0) East))%Z; split; [|reflexivity].
  apply by_drive; [|lia|reflexivity|reflexivity]. now apply by_standing.
Qed.
