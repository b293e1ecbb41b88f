(** FRONTIER-10, and FRONTIER-2 with it: robots that explore cells and correct where they take themselves to be by a share
    of what each fix says, with errors that have bounds: for every number of robots, every floor and every run.

    Lengths are in sides of a cell, so that L/2 is a half. Along each axis a fix errs by at most E and a move by at most
    D, and of what a fix after a move says at least the share K counts. What is left of the error is [slack] at most. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool List Arith.
From Tautline Require Import Lattice Plane.
From Tautline Require Explorers Entering.
Import ListNotations.
Local Open Scope Q_scope.

(** Along one axis: what a robot believes after a fix, of which the share [k] counts. *)
Definition corrected (k believed fix_ : Q) : Q := believed + k * (fix_ - believed).

(** Within half a cell of the midpoint of cell [c]. *)
Definition inside_1 (c : Z) (x : Q) : Prop := Qabs (x - inject_Z c) < 1 # 2.

Section Errors.
  Variables E D K F : Q.
  Definition slack : Q := E + D * ((1 - K) / K).

  (** The cell of a robot by its count, where it is, and where it believes to be. It starts at most F off
      a midpoint. It drives as far as it believes to be from a midpoint, errs by [o], and takes a fix that
      errs by [e], of which the share [k] counts. It may stand and take more fixes, of which any share counts. *)
  Inductive run_1 : Z -> Q -> Q -> Prop :=
  | starts_1 : forall c x, Qabs (x - inject_Z c) <= F -> run_1 c x (inject_Z c)
  | moves_1 : forall c x b d o e k, run_1 c x b -> Qabs o <= D -> Qabs e <= E -> K <= k <= 1 ->
      run_1 d (x + (inject_Z d - b) + o) (corrected k (inject_Z d) (x + (inject_Z d - b) + o + e))
  | stands_1 : forall c x b e k, run_1 c x b -> Qabs e <= E -> 0 <= k <= 1 -> run_1 c x (corrected k b (x + e)).

  Hypothesis errors : 0 <= E /\ 0 <= D /\ 0 < K <= 1.

  Lemma slack_times : K * slack == K * E + D * (1 - K).
  Proof using errors. unfold slack; field; lra. Qed.
  Lemma slack_least : E <= slack.
  Proof using errors.
    destruct errors as [HE [HD [K0 K1]]]. pose proof slack_times as S.
    assert (0 <= D * (1 - K)) by (apply Qmult_le_0_compat; lra).
    assert (K * E <= K * slack) as M by lra. now apply Qmult_le_l in M.
  Qed.
  Lemma slack_bound : E + D / K == slack + D.
  Proof using errors. unfold slack; field; lra. Qed.

  (** Of an error that moves have left, one more move and the fix after it leave no more. *)
  Lemma fix_after_move : forall y e k, Qabs y <= slack + D -> Qabs e <= E -> K <= k <= 1 ->
    Qabs ((1 - k) * y - k * e) <= slack.
  Proof using errors.
    intros y e k Y He [Kk k1]; destruct errors as [HE [HD [K0 K1]]].
    apply Qabs_Qle_condition in Y, He; apply Qabs_Qle_condition. destruct Y as [Y Y'], He as [He He'].
    assert ((1 - k) * (slack + D) + k * E <= slack) as H.
    { assert (k * E + (1 - k) * D <= k * slack) as G; [|setoid_replace ((1 - k) * (slack + D) + k * E)
        with (slack + ((k * E + (1 - k) * D) - k * slack)) by ring; lra].
      assert (slack - E == D * ((1 - K) / K)) as R by (unfold slack; ring).
      assert (0 <= slack - E) as P by (pose proof slack_least; lra).
      assert (K * (slack - E) <= k * (slack - E)) as M by (apply Qmult_le_compat_r; lra).
      assert (K * (slack - E) == D * (1 - K)) as T by (rewrite R; field; lra).
      assert (D * (1 - k) <= D * (1 - K)) as B by (rewrite !(Qmult_comm D); apply Qmult_le_compat_r; lra).
      lra. }
    assert ((1 - k) * y <= (1 - k) * (slack + D)) by (rewrite !(Qmult_comm (1 - k)); apply Qmult_le_compat_r; lra).
    assert ((1 - k) * - (slack + D) <= (1 - k) * y) by (rewrite !(Qmult_comm (1 - k)); apply Qmult_le_compat_r; lra).
    assert (k * e <= k * E) by (rewrite !(Qmult_comm k); apply Qmult_le_compat_r; lra).
    assert (k * - E <= k * e) by (rewrite !(Qmult_comm k); apply Qmult_le_compat_r; lra).
    split; lra.
  Qed.

  Hypothesis start : F <= slack.

  Lemma error_is_bounded : forall c x b, run_1 c x b -> Qabs (x - b) <= slack.
  Proof using errors start.
    intros c x b R; induction R as [c x S|c x b d o e k R IH Ho He Hk|c x b e k R IH He [k0 k1]]; [lra | |].
    - unfold corrected. setoid_replace (x + (inject_Z d - b) + o - (inject_Z d + k * (x + (inject_Z d - b) + o + e - inject_Z d)))
        with ((1 - k) * (x - b + o) - k * e) by ring.
      apply fix_after_move; auto. eapply Qle_trans; [apply Qabs_triangle | now apply Qplus_le_compat].
    - unfold corrected. setoid_replace (x - (b + k * (x + e - b))) with ((1 - k) * (x - b) - k * e) by ring.
      pose proof slack_least as L. apply Qabs_Qle_condition in IH, He; apply Qabs_Qle_condition.
      destruct IH as [I I'], He as [He He'].
      assert ((1 - k) * (x - b) <= (1 - k) * slack) by (rewrite !(Qmult_comm (1 - k)); apply Qmult_le_compat_r; lra).
      assert ((1 - k) * - slack <= (1 - k) * (x - b)) by (rewrite !(Qmult_comm (1 - k)); apply Qmult_le_compat_r; lra).
      assert (k * e <= k * slack) by (rewrite !(Qmult_comm k); apply Qmult_le_compat_r; lra).
      assert (k * - slack <= k * e) by (rewrite !(Qmult_comm k); apply Qmult_le_compat_r; lra).
      split; lra.
  Qed.

  Lemma arrives_inside : forall c x b d o, run_1 c x b -> Qabs o <= D -> E + D / K < 1 # 2 ->
    inside_1 d (x + (inject_Z d - b) + o).
  Proof using errors start.
    intros c x b d o R Ho H; unfold inside_1. rewrite slack_bound in H.
    setoid_replace (x + (inject_Z d - b) + o - inject_Z d) with (x - b + o) by ring.
    eapply Qle_lt_trans; [apply Qabs_triangle|]. pose proof (error_is_bounded _ _ _ R); lra.
  Qed.

  Lemma stays_inside : forall c x b, run_1 c x b -> E + D / K < 1 # 2 -> inside_1 c x.
  Proof using errors start.
    intros c x b R H; induction R as [c x S|c x b d o e k R IH Ho He Hk|c x b e k R IH He Hk]; auto.
    - unfold inside_1; rewrite slack_bound in H. destruct errors as [_ [HD _]]; lra.
    - eapply arrives_inside; eauto.
  Qed.
End Errors.

(** ** On the plane. *)
Definition inside (c : cell) (p : point) : Prop := inside_1 (fst c) (fst p) /\ inside_1 (snd c) (snd p).

Lemma near_whole : forall c x, inside_1 c x -> inject_Z c - (1 # 2) < x < inject_Z c + (1 # 2).
Proof. intros c x I; unfold inside_1 in I; apply Qabs_Qlt_condition in I; lra. Qed.

Lemma whole_less : forall a b : Z, inject_Z a < inject_Z b + 1 -> (a <= b)%Z.
Proof. intros a b H; change 1 with (inject_Z 1) in H; rewrite <- inject_Z_plus, <- Zlt_Qlt in H; lia. Qed.

(** Somewhere between two places, of which one is in a cell and the other one in the same or the next, no other cell is. *)
Lemma between_cells : forall c d x y t e, inside_1 c x -> inside_1 d y -> (Z.abs (c - d) <= 1)%Z -> 0 <= t <= 1 ->
  inside_1 e ((1 - t) * x + t * y) -> e = c \/ e = d.
Proof.
  intros c d x y t e X Y L [T0 T1] H; apply near_whole in X, Y, H.
  assert ((1 - t) * x <= (1 - t) * (inject_Z c + (1 # 2)) /\ (1 - t) * (inject_Z c - (1 # 2)) <= (1 - t) * x)
    by (rewrite !(Qmult_comm (1 - t)); split; apply Qmult_le_compat_r; lra).
  assert (t * y <= t * (inject_Z d + (1 # 2)) /\ t * (inject_Z d - (1 # 2)) <= t * y)
    by (rewrite !(Qmult_comm t); split; apply Qmult_le_compat_r; lra).
  assert ((e <= Z.max c d)%Z /\ (Z.min c d <= e)%Z); [|lia].
  assert (inject_Z c <= inject_Z (Z.max c d)) as C by (rewrite <- Zle_Qle; lia).
  assert (inject_Z d <= inject_Z (Z.max c d)) as C' by (rewrite <- Zle_Qle; lia).
  assert (inject_Z (Z.min c d) <= inject_Z c) as B by (rewrite <- Zle_Qle; lia).
  assert (inject_Z (Z.min c d) <= inject_Z d) as B' by (rewrite <- Zle_Qle; lia).
  assert ((1 - t) * inject_Z c <= (1 - t) * inject_Z (Z.max c d) /\ (1 - t) * inject_Z (Z.min c d) <= (1 - t) * inject_Z c)
    by (rewrite !(Qmult_comm (1 - t)); split; apply Qmult_le_compat_r; lra).
  assert (t * inject_Z d <= t * inject_Z (Z.max c d) /\ t * inject_Z (Z.min c d) <= t * inject_Z d)
    by (rewrite !(Qmult_comm t); split; apply Qmult_le_compat_r; lra).
  set (cq := inject_Z c) in *; set (dq := inject_Z d) in *; set (m := inject_Z (Z.max c d)) in *;
    set (n := inject_Z (Z.min c d)) in *.
  split; apply whole_less; fold m n; lra.
Qed.

Lemma between_neighbours : forall c s p q t e, inside c p -> inside (beyond c s) q -> 0 <= t <= 1 ->
  inside e (between t p q) -> e = c \/ e = beyond c s.
Proof.
  intros [cx cy] s [px py] [qx qy] t [ex ey] [Px Py] [Qx Qy] T [Hx Hy]; cbn [fst snd between] in *.
  destruct (between_cells cx _ px qx t ex Px Qx) as [->| ->]; auto; [destruct s; cbn; lia | |];
    destruct (between_cells cy _ py qy t ey Py Qy) as [->| ->]; auto; try (destruct s; cbn; lia);
    destruct s; unfold beyond; cbn; auto; try (right; f_equal; lia); try (left; f_equal; lia).
Qed.

Lemma inside_one : forall c d p, inside c p -> inside d p -> c = d.
Proof.
  assert (forall a b x, inside_1 a x -> inside_1 b x -> a = b) as One.
  { intros a b x A B; apply near_whole in A, B. assert ((a <= b)%Z /\ (b <= a)%Z) by (split; apply whole_less; lra). lia. }
  intros [cx cy] [dx dy] p [A B] [C D]; f_equal; eapply One; eauto.
Qed.

(** ** The team. *)
Section Team.
  Variables (cells : list cell) (beside : cell -> list cell) (obstacle : cell -> bool) (N : nat).
  Variable rl : Explorers.rule cell.
  Variables E D K F : Q.
  Notation world := (Explorers.world cell).
  Notation place w i := (Explorers.place (Explorers.robots w i)).
  Notation doing w i := (Explorers.doing (Explorers.robots w i)).
  Notation leads := (Explorers.leads cell cell_eqb obstacle N rl).

  Definition errs (most : Q) (o : point) : Prop := Qabs (fst o) <= most /\ Qabs (snd o) <= most.
  Definition counts (least : Q) (k : point) : Prop := least <= fst k <= 1 /\ least <= snd k <= 1.
  (** Where a robot arrives that drives to the midpoint of [d], with the error [o]; and what it believes after a fix. *)
  Definition arrives_at (d : cell) (p b o : point) : point :=
    (fst p + (inject_Z (fst d) - fst b) + fst o, snd p + (inject_Z (snd d) - snd b) + snd o).
  Definition plus (p q : point) : point := (fst p + fst q, snd p + snd q).
  Definition corrected_2 (k b fix_ : point) : point :=
    (corrected (fst k) (fst b) (fst fix_), corrected (snd k) (snd b) (snd fix_)).

  (** A run of Explorers.v, where each robot is, and where each believes to be. A robot may take fixes at any time. *)
  Inductive team : world -> (nat -> point) -> (nat -> point) -> Prop :=
  | team_starts : forall start w p, Explorers.may_start cell cells obstacle N start ->
      Explorers.alike cell N (Explorers.begins cell N start) w ->
      (forall i, (i < N)%nat -> errs F (minus (p i) (centre (start i)))) -> team w p (fun i => centre (start i))
  | team_acts : forall w p b e w', team w p b -> leads w e w' -> (forall i ms, e <> Explorers.Arrives i ms) -> team w' p b
  | team_arrives : forall w p b i ms w' v o e k, team w p b -> leads w (Explorers.Arrives i ms) w' ->
      doing w i = Explorers.Enters v -> errs D o -> errs E e -> counts K k ->
      team w' (Explorers.put p i (arrives_at v (p i) (b i) o))
        (Explorers.put b i (corrected_2 k (centre v) (plus (arrives_at v (p i) (b i) o) e)))
  | team_stands : forall w p b i e k, team w p b -> errs E e -> counts 0 k ->
      team w p (Explorers.put b i (corrected_2 k (b i) (plus (p i) e))).

  Definition run_2 (c : cell) (p b : point) : Prop := run_1 E D K F (fst c) (fst p) (fst b) /\ run_1 E D K F (snd c) (snd p) (snd b).

  Lemma team_runs : forall w p b, team w p b -> Explorers.run cell cell_eqb cells obstacle N rl w
    /\ forall i, (i < N)%nat -> run_2 (place w i) (p i) (b i).
  Proof.
    intros w p b T; induction T as [start w p M A S|w p b e w' T [R I] L No|w p b i ms w' v o e k T [R I] L Do [Ox Oy] [Ex Ey]
      [Kx Ky]|w p b i e k T [R I] [Ex Ey] [Kx Ky]].
    - split; [eapply Explorers.run_start; eauto|]. intros i H; destruct (S i H) as [X Y]; destruct A as [A _].
      rewrite <- (A i H); cbn [Explorers.robots Explorers.begins Explorers.place]. split; apply starts_1; assumption.
    - split; [eapply Explorers.run_step; eauto|]. intros i H.
      pose proof (Entering.step_turns cell cell_eqb obstacle N rl w e w' L i H) as X.
      assert (place w' i = place w i) as ->; [|now apply I].
      inversion X as [e' Eq|v c ms S Eq B|v ms un sl S Eq B|v ms un sl S M O Eq B|v ms S Eq B]; try reflexivity.
      exfalso; eapply No; symmetry; exact Eq.
    - split; [eapply Explorers.run_step; eauto|]. intros j H.
      pose proof (Entering.step_turns cell cell_eqb obstacle N rl w _ w' L j H) as X. unfold Explorers.put.
      destruct (Nat.eqb_spec j i) as [->|Dj].
      + assert (place w' i = v) as ->.
        { destruct L as [x [L [A _]]]; rewrite <- (A i H). cbn [Explorers.next] in L; rewrite Do in L.
          destruct (Nat.ltb_spec i N) as [|]; [|lia]. injection L as <-.
          rewrite (proj1 (Explorers.settle_robots _ _ _ _)); cbn [Explorers.robots]. unfold Explorers.tells; rewrite Nat.eqb_refl.
          cbn [orb]; unfold Explorers.put; now rewrite Nat.eqb_refl. }
        destruct (I i H) as [Rx Ry].
        split; [exact (moves_1 E D K F _ _ _ (fst v) _ _ _ Rx Ox Ex Kx) | exact (moves_1 E D K F _ _ _ (snd v) _ _ _ Ry Oy Ey Ky)].
      + assert (place w' j = place w j) as ->; [|now apply I].
        inversion X; try reflexivity. congruence.
    - split; [exact R|]. intros j H; unfold Explorers.put; destruct (Nat.eqb_spec j i) as [->|Dj]; [|now apply I].
      destruct (I i H) as [Rx Ry]; split; cbn; apply stands_1; assumption.
  Qed.

  (** Where robot [i] may be: at its place, or, while it enters a cell, somewhere on its straight way there. *)
  Definition may_be (w : world) (p b : nat -> point) (i : nat) (q : point) : Prop :=
    q = p i \/ exists v o t, doing w i = Explorers.Enters v /\ errs D o /\ 0 <= t <= 1
                /\ q = between t (p i) (arrives_at v (p i) (b i) o).
End Team.

(** Of every team on every floor each robot is in the cell that it has counted, whatever it has driven and told. *)
Theorem FRONTIER_10 : forall E D K F, 0 <= E /\ 0 <= D /\ 0 < K <= 1 -> F <= slack E D K -> E + D / K < 1 # 2 ->
  forall cells obstacle N rl w p b, team cells obstacle N rl E D K F w p b -> forall i, (i < N)%nat ->
  inside (Explorers.place (Explorers.robots w i)) (p i).
Proof.
  intros E D K F Er St B cells obstacle N rl w p b T i I. destruct (team_runs _ _ _ _ _ _ _ _ _ _ _ T) as [_ R].
  destruct (R i I) as [X Y]; split; eapply stays_inside; eauto.
Qed.

(** So no two are in one cell, not on their ways either: what holds of robots at midpoints (FRONTIER-2) holds of them. *)
Theorem no_two_in_one_cell : forall E D K F, 0 <= E /\ 0 <= D /\ 0 < K <= 1 -> F <= slack E D K -> E + D / K < 1 # 2 ->
  forall cells beside obstacle N rl, (forall u v, In v (beside u) -> In v cells /\ exists s, v = beyond u s) ->
  Explorers.sensible cell cell_eqb cells beside rl ->
  forall w p b, team cells obstacle N rl E D K F w p b -> forall i j, (i < N)%nat -> (j < N)%nat -> i <> j ->
  forall q q', may_be D w p b i q -> may_be D w p b j q' -> forall c, ~ (inside c q /\ inside c q').
Proof.
  intros E D K F Er St B cells beside obstacle N rl Be Se w p b T.
  destruct (team_runs _ _ _ _ _ _ _ _ _ _ _ T) as [R Runs].
  assert (forall i, (i < N)%nat -> forall q, may_be D w p b i q -> forall c, inside c q ->
    c = Explorers.place (Explorers.robots w i) \/ Explorers.doing (Explorers.robots w i) = Explorers.Enters c) as One.
  { intros i I q [->|[v [o [t [Do [[Ox Oy] [Ht ->]]]]]]] c H.
    - left; eapply inside_one; eauto. eapply FRONTIER_10; eauto.
    - assert (In v (beside (Explorers.place (Explorers.robots w i)))) as Nb.
      { destruct (Explorers.placed_always cell cell_eqb cells beside obstacle N cell_eqb_spec (fun u v X => proj1 (Be u v X))
          rl w Se R i I) as [_ [_ P]]; now rewrite Do in P. }
      destruct (proj2 (Be _ _ Nb)) as [s ->]. destruct (Runs i I) as [Rx Ry].
      assert (c = Explorers.place (Explorers.robots w i) \/ c = beyond (Explorers.place (Explorers.robots w i)) s) as [->| ->];
        [|auto|auto]. apply between_neighbours with (4 := H); [eapply FRONTIER_10; eauto | | exact Ht].
      split; [exact (arrives_inside E D K F Er St _ _ _ _ _ Rx Ox B) | exact (arrives_inside E D K F Er St _ _ _ _ _ Ry Oy B)]. }
  intros i j I J Dij q q' Hq Hq' c [Hc Hc'].
  destruct (Entering.FRONTIER_2 cell cell_eqb cells obstacle N rl cell_eqb_spec w R i j I J Dij) as [P En].
  destruct (Entering.FRONTIER_2 cell cell_eqb cells obstacle N rl cell_eqb_spec w R j i J I (not_eq_sym Dij)) as [_ En'].
  destruct (One i I q Hq c Hc) as [->|Ei], (One j J q' Hq' _ Hc') as [E'|Ej].
  - contradiction.
  - destruct (En' _ Ej) as [X _]; now apply X.
  - destruct (En _ Ei) as [X _]; now apply X.
  - destruct (En _ Ei) as [_ X]; now apply X.
Qed.

(** ** The bound is sharp. *)
(** At the bound a robot may be on the rim, if it starts as far off as moves may come near to. *)
Theorem at_its_bound_FRONTIER_10_breaks : forall E D K, 0 <= E /\ 0 <= D /\ 0 < K <= 1 -> E + D / K == 1 # 2 ->
  exists x b, run_1 E D K (slack E D K) 1 x b /\ ~ inside_1 1 x.
Proof.
  intros E D K Er B; pose proof (slack_bound E D K Er) as S; pose proof (slack_least E D K Er) as L; destruct Er as [HE [HD HK]].
  eexists; eexists; split.
  - apply moves_1 with (c := 0%Z) (x := slack E D K) (b := inject_Z 0) (o := D) (e := 0) (k := K); [| | |lra].
    + apply starts_1; apply Qabs_Qle_condition; change (inject_Z 0) with 0; lra.
    + apply Qabs_Qle_condition; lra.
    + apply Qabs_Qle_condition; lra.
  - intros I; apply near_whole in I; change (inject_Z 1) with 1 in I; change (inject_Z 0) with 0 in I; lra.
Qed.

(** Beyond it enough moves bring a robot out of its cell that has started at a midpoint. *)
Section Beyond.
  Variables E D K : Q.
  Hypothesis errors : 0 <= E /\ 0 <= D /\ 0 < K <= 1.

  (** What is left of the error after so many moves that err as much as they may. *)
  Fixpoint left_over (n : nat) : Q := match n with O => 0 | S n => (1 - K) * (left_over n + D) + K * E end.
  Fixpoint power (n : nat) : Q := match n with O => 1 | S n => (1 - K) * power n end.

  Lemma left_over_is : forall n, left_over n == slack E D K * (1 - power n).
  Proof using errors.
    intros n; pose proof (slack_times E D K errors) as S; induction n as [|n IH]; cbn [left_over power]; [ring|].
    rewrite IH. setoid_replace ((1 - K) * (slack E D K * (1 - power n) + D) + K * E)
      with (slack E D K * (1 - (1 - K) * power n) + (K * E + D * (1 - K) - K * slack E D K)) by ring. rewrite S; ring.
  Qed.
  Lemma power_falls : forall n, 0 <= power n /\ power n * (1 + inject_Z (Z.of_nat n) * K) <= 1.
  Proof using errors.
    destruct errors as [_ [_ [K0 K1]]]. induction n as [|n [P B]]; cbn [power]; [change (inject_Z (Z.of_nat 0)) with 0; split; lra|].
    assert (0 <= (1 - K) * power n) as Q0 by (apply Qmult_le_0_compat; lra). split; [exact Q0|].
    rewrite Nat2Z.inj_succ; unfold Z.succ; rewrite inject_Z_plus; change (inject_Z 1) with 1.
    set (m := inject_Z (Z.of_nat n)) in *.
    assert (0 <= m) by (unfold m; change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia).
    setoid_replace ((1 - K) * power n * (1 + (m + 1) * K)) with (power n * (1 + m * K) - power n * ((m + 1) * (K * K))) by ring.
    assert (0 <= power n * ((m + 1) * (K * K))); [|lra].
    apply Qmult_le_0_compat; [exact P|]. apply Qmult_le_0_compat; [lra | apply Qmult_le_0_compat; lra].
  Qed.
  Lemma comes_so_far : forall n, exists c x b, run_1 E D K 0 c x b /\ x - b == left_over n.
  Proof using errors.
    destruct errors as [HE [HD [K0 K1]]]. assert (0 <= slack E D K) as S by (pose proof (slack_least E D K errors); lra).
    induction n as [|n [c [x [b [R X]]]]].
    - exists 0%Z, (inject_Z 0), (inject_Z 0); split; [apply starts_1; apply Qabs_Qle_condition; lra | cbn [left_over]; lra].
    - eexists 0%Z, _, _; split; [apply (moves_1 E D K 0 c x b 0 D (- E) K R); try apply Qabs_Qle_condition; lra|].
      unfold corrected; cbn [left_over]; rewrite <- X; change (inject_Z 0) with 0; ring.
  Qed.
End Beyond.

Theorem beyond_its_bound_FRONTIER_10_breaks : forall E D K, 0 <= E /\ 0 <= D /\ 0 < K <= 1 -> 1 # 2 < E + D / K ->
  exists c x b, run_1 E D K 0 c x b /\ ~ inside_1 c x.
Proof.
  intros E D K Er B; pose proof (slack_bound E D K Er) as Sb; pose proof (slack_least E D K Er) as L.
  pose proof Er as [HE [HD [K0 K1]]].
  set (m := slack E D K + D - (1 # 2)). assert (0 < m) as M by (unfold m; lra).
  assert (0 < K * m) as KM by (rewrite <- (Qmult_0_l m); apply Qmult_lt_compat_r; assumption).
  destruct (Qlt_le_dec (slack E D K) 0) as [N|S0]; [lra|].
  set (n := Z.to_nat (Qround.Qceiling (slack E D K / (K * m)))).
  assert (slack E D K <= inject_Z (Z.of_nat n) * (K * m)) as A.
  { pose proof (Qround.Qle_ceiling (slack E D K / (K * m))) as C.
    assert (slack E D K == slack E D K / (K * m) * (K * m)) as -> by (field; split; lra).
    apply Qmult_le_compat_r; [|lra]. eapply Qle_trans; [exact C|]. rewrite <- Zle_Qle; unfold n; lia. }
  destruct (comes_so_far E D K Er n) as [c [x [b [R X]]]].
  eexists; eexists; eexists; split; [apply (moves_1 E D K 0 c x b 0 D 0 K R); try apply Qabs_Qle_condition; lra|].
  intros I; apply near_whole in I; change (inject_Z 0) with 0 in I.
  rewrite (left_over_is E D K Er) in X. destruct (power_falls E D K Er n) as [P Pb].
  assert (power K n * slack E D K <= power K n * (inject_Z (Z.of_nat n) * (K * m)))
    by (rewrite !(Qmult_comm (power K n)); apply Qmult_le_compat_r; assumption).
  assert (power K n * (inject_Z (Z.of_nat n) * (K * m)) <= m).
  { setoid_replace (power K n * (inject_Z (Z.of_nat n) * (K * m))) with ((power K n * (inject_Z (Z.of_nat n) * K)) * m) by ring.
    setoid_replace m with (1 * m) at 2 by ring. apply Qmult_le_compat_r; lra. }
  unfold m in *; lra.
Qed.

(** A budget without the share, E + D < L/2, is not enough. *)
Theorem without_the_share_FRONTIER_10_breaks : exists E D K c x b, 0 <= E /\ 0 <= D /\ 0 < K <= 1 /\ E + D < 1 # 2
  /\ run_1 E D K 0 c x b /\ ~ inside_1 c x.
Proof.
  destruct (beyond_its_bound_FRONTIER_10_breaks 0 (3 # 8) (1 # 4)) as [c [x [b H]]]; [repeat split; discriminate | reflexivity|].
  exists 0, (3 # 8), (1 # 4), c, x, b; repeat split; try discriminate; tauto.
Qed.
