(** Frontier cells, idealised: robots share one map and act one at a time. For every number of robots, every finite graph
    of cells, every set of obstacles and every order: two robots are never in one cell, every run ends within a stated
    number of steps, a robot that has a way left is never stuck, and at the end all that can be reached is explored.

    A robot that acts takes any first step of any shortest way through explored cells to an unknown cell. It finds
    an obstacle there and records it; or enters the cell; or meets a robot in it, and stays. The kernel's robots have a
    map each, move in three phases and send messages: nothing ties the model to them, and the ledger does not speak of
    it. *)
From Coq Require Import Lia Bool List Arith.
Import ListNotations.

(** ** Numbers. *)
Lemma filter_less : forall (A : Type) (f g : A -> bool) l, (forall x, g x = true -> f x = true) ->
  (exists x, In x l /\ f x = true /\ g x = false) -> length (filter g l) < length (filter f l).
Proof.
  intros A f g l H [x [I [F G]]].
  assert (forall l, length (filter g l) <= length (filter f l)) as LE.
  { induction l0 as [|y r IH]; cbn; [lia|]. destruct (g y) eqn:Y; [rewrite (H y Y); cbn; lia | destruct (f y); cbn; lia]. }
  induction l as [|y r IH]; [destruct I|]. cbn; destruct I as [<-|I].
  - rewrite F, G; cbn; specialize (LE r); lia.
  - specialize (IH I); destruct (g y) eqn:Y; [rewrite (H y Y); cbn; lia | destruct (f y); cbn; lia].
Qed.

Definition total (n : nat) (f : nat -> nat) : nat := list_sum (map f (seq 0 n)).
Lemma total_S : forall n f, total (S n) f = total n f + f n.
Proof. intros n f; unfold total; rewrite seq_S, map_app, list_sum_app; cbn; lia. Qed.
Lemma total_most : forall n f b, (forall i, i < n -> f i <= b) -> total n f <= n * b.
Proof.
  induction n as [|n IH]; intros f b H; [cbn; lia|]. rewrite total_S; specialize (IH f b); specialize (H n) as Hn.
  assert (total n f <= n * b) by (apply IH; auto). assert (f n <= b) by auto. cbn; lia.
Qed.
Lemma total_less : forall n f g j, j < n -> g j < f j -> (forall i, i <> j -> g i = f i) -> total n g < total n f.
Proof.
  induction n as [|n IH]; intros f g j L D S; [lia|]. rewrite !total_S; destruct (Nat.eq_dec n j) as [->|NE].
  - assert (total j g = total j f) as ->; [|lia]. clear - S.
    assert (forall m, m <= j -> total m g = total m f) as H; [|auto].
    induction m as [|m IH]; intros L; [reflexivity|]. rewrite !total_S, IH, S by lia; reflexivity.
  - rewrite (S n NE); assert (total n g < total n f) by (apply (IH f g j); auto; lia); lia.
Qed.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool).
  Variable N : nat.
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_cells : forall u v, In v (beside u) -> In v cells.

  (** What all know, and where they are. *)
  Record state := { explored : V -> bool; blocked : V -> bool; at_ : nat -> V }.
  Definition unknown (e b : V -> bool) (v : V) : bool := negb (e v) && negb (b v).
  (** [n] steps lead from [u] through explored cells to an unknown one. *)
  Fixpoint way (e b : V -> bool) (n : nat) (u : V) : bool :=
    match n with
    | O => unknown e b u
    | S m => existsb (fun v => match m with O => true | _ => e v end && way e b m v) (beside u)
    end.
  Definition least (e b : V -> bool) (u : V) (n : nat) : Prop :=
    way e b n u = true /\ forall m, m < n -> way e b m u = false.

  Definition add (f : V -> bool) (v : V) : V -> bool := fun x => same x v || f x.
  Definition put (p : nat -> V) (i : nat) (v : V) : nat -> V := fun j => if j =? i then v else p j.
  (** Robot [i] is about to go to [v], the first cell of a shortest way of S [n] steps. *)
  Definition tries (s : state) (i : nat) (v : V) (n : nat) : Prop :=
    i < N /\ least (explored s) (blocked s) (at_ s i) (S n) /\ In v (beside (at_ s i))
    /\ way (explored s) (blocked s) n v = true /\ (n <> 0 -> explored s v = true).
  Definition free (s : state) (i : nat) (v : V) : Prop := forall j, j < N -> j <> i -> at_ s j <> v.

  Inductive step (s : state) : state -> Prop :=
  | records : forall i v, tries s i v 0 -> free s i v -> obstacle v = true ->
      step s {| explored := explored s; blocked := add (blocked s) v; at_ := at_ s |}
  | enters : forall i v, tries s i v 0 -> free s i v -> obstacle v = false ->
      step s {| explored := add (explored s) v; blocked := blocked s; at_ := put (at_ s) i v |}
  | goes : forall i v n, tries s i v (S n) -> free s i v ->
      step s {| explored := explored s; blocked := blocked s; at_ := put (at_ s) i v |}.
  (** Robots start in different free cells, and all know these. A robot that meets another one changes nothing: that is
      no step. *)
  Inductive run : nat -> state -> Prop :=
  | run_start : forall s, (forall i, i < N -> explored s (at_ s i) = true /\ In (at_ s i) cells) ->
      (forall i j, i < N -> j < N -> at_ s i = at_ s j -> i = j) ->
      (forall v, explored s v = true -> obstacle v = false) -> (forall v, blocked s v = true -> obstacle v = true) ->
      run 0 s
  | run_step : forall k s s', run k s -> step s s' -> run (S k) s'.

  Definition good (s : state) : Prop :=
    (forall i, i < N -> explored s (at_ s i) = true /\ In (at_ s i) cells)
    /\ (forall i j, i < N -> j < N -> at_ s i = at_ s j -> i = j)
    /\ (forall v, explored s v = true -> obstacle v = false) /\ (forall v, blocked s v = true -> obstacle v = true).

  Lemma put_same : forall p i v, put p i v i = v. Proof. intros; unfold put; now rewrite Nat.eqb_refl. Qed.
  Lemma put_other : forall p i v j, j <> i -> put p i v j = p j.
  Proof. intros p i v j D; unfold put; apply Nat.eqb_neq in D; now rewrite D. Qed.
  Lemma add_true : forall f v x, add f v x = true <-> x = v \/ f x = true.
  Proof. intros; unfold add; now rewrite orb_true_iff, same_spec. Qed.

  Lemma put_apart : forall s i v, (forall i j, i < N -> j < N -> at_ s i = at_ s j -> i = j) -> free s i v ->
    forall j k, j < N -> k < N -> put (at_ s) i v j = put (at_ s) i v k -> j = k.
  Proof.
    intros s i v A F j k Lj Lk E.
    destruct (Nat.eq_dec j i) as [->|J], (Nat.eq_dec k i) as [->|K]; rewrite ?put_same, ?put_other in E by assumption; auto.
    - exfalso; apply (F k); auto.
    - exfalso; apply (F j); auto.
  Qed.

  Lemma good_always : forall k s, run k s -> good s.
  Proof.
    intros k s R; induction R as [s A B C D | k s s' R [A [B [C D]]] T]; [repeat split; auto; now apply A|].
    destruct T as [i v T F O | i v T F O | i v n T F]; unfold good; cbn [explored blocked at_].
    - repeat split; auto; try (now apply A). intros x X; apply add_true in X; destruct X as [->|X]; auto.
    - destruct T as [_ [_ [B1 _]]]. split; [|split; [now apply put_apart | split; auto]].
      + intros j L; destruct (Nat.eq_dec j i) as [->|J]; rewrite ?put_same, ?put_other by assumption.
        * split; [apply add_true; auto | eapply beside_cells; eauto].
        * split; [apply add_true; right|]; now apply A.
      + intros x X; apply add_true in X; destruct X as [->|X]; auto.
    - destruct T as [_ [_ [B1 [_ E]]]]. split; [|split; [now apply put_apart | split; auto]].
      intros j L; destruct (Nat.eq_dec j i) as [->|J]; rewrite ?put_same, ?put_other by assumption; auto.
      split; [now apply E | eapply beside_cells; eauto].
  Qed.

  (** ** Shortest ways. *)
  Lemma way_longer : forall e b n u v, In v (beside u) -> e v = true -> way e b n v = true -> way e b (S n) u = true.
  Proof.
    intros e b n u v I E W; cbn [way]; apply existsb_exists; exists v; split; [exact I|]; rewrite W.
    destruct n; [reflexivity | now rewrite E].
  Qed.
  Lemma least_next : forall e b u v n, least e b u (S n) -> In v (beside u) -> e v = true -> way e b n v = true ->
    least e b v n.
  Proof.
    intros e b u v n [_ M] I E W; split; [exact W|]. intros m L; destruct (way e b m v) eqn:X; [|reflexivity].
    rewrite <- (M (S m)) by lia; symmetry; eapply way_longer; eauto.
  Qed.
  Lemma least_unique : forall e b u n m, least e b u n -> least e b u m -> n = m.
  Proof.
    intros e b u n m [W M] [W' M']; destruct (Nat.lt_trichotomy n m) as [L|[L|L]]; [|exact L|].
    - rewrite (M' n L) in W; discriminate.
    - rewrite (M m L) in W'; discriminate.
  Qed.
  Lemma some_least : forall e b u n, way e b n u = true -> exists m, least e b u m.
  Proof.
    intros e b u n W; destruct (find (fun m => way e b m u) (seq 0 (S n))) as [m|] eqn:F.
    - exists m; apply find_some in F as G; destruct G as [_ G]; split; [exact G|]. intros k L.
      clear - F L. assert (forall a c, find (fun m => way e b m u) (seq a c) = Some m -> forall k, a <= k -> k < m ->
        way e b k u = false) as H; [|apply (H 0 (S n)); auto; lia].
      intros a c; revert a; induction c as [|c IH]; intros a E k' La Lb; [discriminate|]. cbn in E.
      destruct (way e b a u) eqn:X; [injection E as ->; lia|].
      destruct (Nat.eq_dec a k') as [->|D]; [exact X | apply (IH (S a)); auto; lia].
    - eapply find_none in F; [|apply in_seq; split; [apply Nat.le_0_l | apply Nat.lt_succ_diag_r]]; cbn in F; congruence.
  Qed.
  (** The cells of a shortest way are all different: it is no longer than there are cells. *)
  Lemma least_short : forall e b n u, least e b u n -> In u cells -> exists l, length l = S n /\ NoDup l /\ incl l cells
    /\ forall x, In x l -> exists m, m <= n /\ least e b x m.
  Proof.
    induction n as [|n IH]; intros u L I.
    - exists [u]; repeat split; [repeat constructor; auto | intros x [<-|[]]; auto | intros x [<-|[]]; eauto].
    - destruct L as [W M]; cbn [way] in W; apply existsb_exists in W; destruct W as [v [B X]].
      apply andb_true_iff in X; destruct X as [E X].
      assert (least e b v n) as Lv.
      { destruct n; [split; [exact X | lia]|]. eapply least_next; [split; [|exact M]| | |]; eauto.
        cbn [way]; apply existsb_exists; exists v; split; [exact B|]; rewrite E; exact X. }
      destruct (IH v Lv (beside_cells _ _ B)) as [l [Ll [ND [Inc F]]]]. exists (u :: l); repeat split.
      + cbn; now rewrite Ll.
      + constructor; [|exact ND]. intros Iu; destruct (F u Iu) as [m [Lm [Wm _]]]; rewrite M in Wm by lia; discriminate.
      + intros x [<-|Ix]; auto.
      + intros x [<-|Ix]; [exists (S n); split; auto|].
        * split; [|exact M]. cbn [way]; apply existsb_exists; exists v; split; [exact B|]. now rewrite E, X.
        * destruct (F x Ix) as [m [Lm Y]]; exists m; split; [lia | exact Y].
  Qed.
  Lemma least_bound : forall e b n u, least e b u n -> In u cells -> n < length cells.
  Proof.
    intros e b n u L I; destruct (least_short e b n u L I) as [l [Ll [ND [Inc _]]]].
    pose proof (NoDup_incl_length ND Inc); lia.
  Qed.

  (** The distance of a cell, 0 if there is no way. *)
  Definition dist (e b : V -> bool) (u : V) : nat :=
    match find (fun n => way e b n u) (seq 0 (length cells)) with Some n => n | None => 0 end.
  Lemma dist_most : forall e b u, dist e b u <= length cells.
  Proof.
    intros e b u; unfold dist; destruct (find _ _) as [n|] eqn:F; [|lia].
    apply find_some in F; destruct F as [F _]; apply in_seq in F; lia.
  Qed.
  Lemma dist_least : forall e b u n, In u cells -> least e b u n -> dist e b u = n.
  Proof.
    intros e b u n I L; pose proof (least_bound _ _ _ _ L I) as B; unfold dist.
    destruct (find _ _) as [m|] eqn:F.
    - apply find_some in F as G; destruct G as [_ G]; destruct L as [W M].
      destruct (Nat.lt_trichotomy m n) as [X|[X|X]]; [rewrite M in G by exact X; discriminate | exact X |].
      exfalso; clear - F W X. assert (forall c a, find (fun n => way e b n u) (seq a c) = Some m -> a <= n -> n < m -> False)
        as H; [|apply (H _ 0 F); lia].
      induction c as [|c IH]; intros a E La Lb; [discriminate|]. cbn in E; destruct (way e b a u) eqn:Y.
      + injection E as ->; lia.
      + apply (IH (S a)); auto. destruct (Nat.eq_dec a n) as [->|]; [congruence | lia].
    - eapply find_none in F; [|apply in_seq; split; [apply Nat.le_0_l | exact B]]; cbn in F; destruct L; congruence.
  Qed.

  (** ** Every run ends. *)
  Definition measure (s : state) : nat :=
    length (filter (unknown (explored s) (blocked s)) cells) * S (N * length cells)
    + total N (fun i => dist (explored s) (blocked s) (at_ s i)).

  Lemma gain_less : forall (s s' : state),
    (forall x, unknown (explored s') (blocked s') x = true -> unknown (explored s) (blocked s) x = true) ->
    (exists x, In x cells /\ unknown (explored s) (blocked s) x = true /\ unknown (explored s') (blocked s') x = false) ->
    measure s' < measure s.
  Proof.
    intros s s' H E; pose proof (filter_less _ _ _ cells H E) as F; unfold measure.
    assert (total N (fun i => dist (explored s') (blocked s') (at_ s' i)) <= N * length cells)
      by (apply total_most; intros; apply dist_most).
    nia.
  Qed.

  Theorem step_less : forall s s', good s -> step s s' -> measure s' < measure s.
  Proof.
    intros s s' G T; destruct T as [i v T F O | i v T F O | i v n T F].
    - destruct T as [L [_ [B [W _]]]]; apply gain_less; cbn [explored blocked at_ way] in *; unfold unknown, add in *.
      + intros x; destruct (explored s x), (same x v), (blocked s x); cbn; auto.
      + exists v; split; [eapply beside_cells; eauto|]; split; [exact W|].
        rewrite (proj2 (same_spec v v) eq_refl); now rewrite andb_false_r.
    - destruct T as [L [_ [B [W _]]]]; apply gain_less; cbn [explored blocked at_ way] in *; unfold unknown, add in *.
      + intros x; destruct (explored s x), (same x v), (blocked s x); cbn; auto.
      + exists v; split; [eapply beside_cells; eauto|]; split; [exact W|].
        now rewrite (proj2 (same_spec v v) eq_refl).
    - destruct T as [L [Le [B [W E]]]]; unfold measure; cbn [explored blocked at_].
      apply Nat.add_lt_mono_l; apply total_less with (j := i); [exact L | |].
      + rewrite put_same. destruct G as [G _]; destruct (G i L) as [_ I].
        rewrite (dist_least _ _ _ _ I Le), (dist_least _ _ v (S n)); [lia | eapply beside_cells; eauto|].
        eapply least_next; eauto.
      + intros j D; now rewrite put_other.
  Qed.

  Theorem run_short : forall k s, run k s -> exists s0, run 0 s0 /\ k + measure s <= measure s0.
  Proof.
    intros k s R; induction R as [s A B C D | k s s' R [s0 [R0 L]] T].
    - exists s; split; [now apply run_start | lia].
    - exists s0; split; [exact R0|]. pose proof (step_less s s' (good_always _ _ R) T); lia.
  Qed.

  (** FRONTIER-3 of the model: no run makes more steps than this, whatever the order. *)
  Theorem every_run_ends : forall k s, run k s -> k <= length cells * S (N * length cells) + N * length cells.
  Proof.
    intros k s R; destruct (run_short k s R) as [s0 [_ L]]; unfold measure in L.
    assert (total N (fun i => dist (explored s0) (blocked s0) (at_ s0 i)) <= N * length cells)
      by (apply total_most; intros; apply dist_most).
    assert (forall f : V -> bool, length (filter f cells) <= length cells) as H0
      by (clear; induction cells as [|x r IH]; intros f; cbn; [lia | destruct (f x); cbn; specialize (IH f); lia]).
    specialize (H0 (unknown (explored s0) (blocked s0))). nia.
  Qed.

  (** While a robot has a way left, one can make a step: the nearest one, since no robot is in its way. *)
  Theorem never_stuck : forall k s i n, run k s -> i < N -> way (explored s) (blocked s) n (at_ s i) = true ->
    exists s', step s s'.
  Proof.
    intros k s i n R L W; destruct (good_always _ _ R) as [G [_ [C D]]].
    assert (exists j m, j < N /\ least (explored s) (blocked s) (at_ s j) m
      /\ forall l x, l < N -> least (explored s) (blocked s) (at_ s l) x -> m <= x) as [j [m [Lj [Le Min]]]].
    { apply some_least in W; destruct W as [m W]. revert i L W; induction m as [m IH] using lt_wf_ind; intros i L W.
      destruct (existsb (fun l => existsb (fun x => way (explored s) (blocked s) x (at_ s l)) (seq 0 m)) (seq 0 N)) eqn:X.
      - apply existsb_exists in X; destruct X as [l [Il X]]; apply existsb_exists in X; destruct X as [x [Ix X]].
        apply in_seq in Il, Ix. apply some_least in X as Y; destruct Y as [y Y].
        apply (IH y) with (i := l); auto; try lia. destruct Y as [Y Z]; destruct (Nat.le_gt_cases y x); [lia|].
        rewrite Z in X by lia; discriminate.
      - exists i, m; repeat split; auto; try apply W. intros l x Ll [Y Z].
        destruct (Nat.le_gt_cases m x) as [|K]; [assumption|]; exfalso.
        apply not_true_iff_false in X; apply X; apply existsb_exists; exists l; split; [apply in_seq; lia|].
        apply existsb_exists; exists x; split; [apply in_seq; lia | exact Y]. }
    destruct m as [|m].
    { destruct Le as [Le _]; cbn in Le; unfold unknown in Le; destruct (G j Lj) as [E _]; now rewrite E in Le. }
    pose proof Le as [W' M]; cbn [way] in W'; apply existsb_exists in W'; destruct W' as [v [B X]].
    apply andb_true_iff in X; destruct X as [E X].
    assert (tries s j v m) as T.
    { repeat split; auto; try apply Le. intros Z; destruct m; [lia | exact E]. }
    assert (free s j v) as F.
    { intros l Ll Dl <-; destruct m as [|m].
      - cbn in X; unfold unknown in X; destruct (G l Ll) as [K _]; now rewrite K in X.
      - assert (least (explored s) (blocked s) (at_ s l) (S m)) as Y by (eapply least_next; eauto).
        specialize (Min l (S m) Ll Y); lia. }
    destruct m as [|m]; [destruct (obstacle v) eqn:O|]; eexists; [eapply records | eapply enters | eapply goes]; eauto.
  Qed.

  (** FRONTIER-1 of the model: where no robot has a way left, every cell that free cells join to one of them is explored. *)
  Inductive joined : V -> V -> Prop :=
  | joined_self : forall u, joined u u
  | joined_over : forall u v w, joined u v -> In w (beside v) -> obstacle w = false -> joined u w.

  Theorem all_that_is_joined_is_explored : forall k s i, run k s -> i < N ->
    (forall n, way (explored s) (blocked s) n (at_ s i) = false) ->
    forall v, joined (at_ s i) v -> explored s v = true.
  Proof.
    intros k s i R L H v J; destruct (good_always _ _ R) as [G [_ [C D]]].
    assert (explored s v = true /\ forall n, way (explored s) (blocked s) n v = false) as [X _]; [|exact X].
    remember (at_ s i) as u; induction J as [u | u v w J IH B O].
    - split; [subst; now apply G | exact H].
    - destruct (IH Hequ H) as [E W].
      assert (explored s w = true) as Ew.
      { destruct (explored s w) eqn:X; [reflexivity|exfalso]. specialize (W 1); cbn [way] in W.
        apply not_true_iff_false in W; apply W; apply existsb_exists; exists w; split; [exact B|]; cbn.
        unfold unknown; rewrite X; cbn. destruct (blocked s w) eqn:Y; [apply D in Y; congruence | reflexivity]. }
      split; [exact Ew|]. intros n; destruct (way _ _ n w) eqn:X; [|reflexivity].
      rewrite <- (W (S n)); symmetry; eapply way_longer; eauto.
  Qed.

  (** FRONTIER-2 of the model: two robots are never in one cell. *)
  Theorem no_two_in_one_cell : forall k s i j, run k s -> i < N -> j < N -> i <> j -> at_ s i <> at_ s j.
  Proof. intros k s i j R Li Lj D E; destruct (good_always _ _ R) as [_ [A _]]; auto. Qed.
End Area.
