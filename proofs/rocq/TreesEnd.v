(** The end of runs of agents that search in trees, brick-tree, helpers and careful ones: BRICKS-5, 6 and 11, for every
    number of agents, every finite floor, every order of turns and whatever sensors are missed, with a bound. TreesTie.v
    compares the kernel's runs. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Trees.
From Tautline Require Marking Ants Frontier.
Import ListNotations.

Section Ends.
  Variables (cell : Type) (same : cell -> cell -> bool) (beside : cell -> cell -> Prop) (cells : list cell).
  Notation floor := (Trees.floor cell).
  Notation acts := (Trees.acts cell beside).
  Notation Wall := (Trees.Wall cell). Notation Open := (Trees.Open cell). Notation Visited := (Trees.Visited cell).
  Notation accessible := (Trees.accessible cell).

  (** What is written in one turn. *)
  Inductive writes (f : floor) (used : list nat) : floor -> list nat -> Prop :=
  | once : forall g used', acts f used g used' -> writes f used g used'
  | again : forall g used' h used'', writes f used g used' -> acts g used' h used'' -> writes f used h used''.

  (** Where an agent goes that writes nothing: to a child, to a tree with a greater label, to a cell that is not
      visited, or where a visited cell says that more was left. *)
  Inductive walks (f : floor) (c d : cell) : Prop :=
  | to_child : forall m q, f c = Open m q -> f d = Open m (Some c) -> walks f c d
  | to_higher : forall l q m r, f c = Open l q -> f d = Open m r -> l < m -> walks f c d
  | leaves : forall e, f c = Visited e -> accessible f d -> walks f c d
  | follows : f c = Visited (Some d) -> walks f c d.

  (** Where an agent is until it is done, and whether it may stray: in its last turn it has written, or missed a
      sensor. *)
  Definition place : Type := option (cell * bool).
  Inductive turn (f : floor) (used : list nat) (c : cell) (may missed : bool) : floor -> list nat -> place -> Prop :=
  | goes_on : forall g used' d, writes f used g used' -> turn f used c may missed g used' (Some (d, true))
  | walks_on : forall d, walks f c d -> turn f used c may missed f used (Some (d, missed))
  | strays : forall d, may || missed = true -> turn f used c may missed f used (Some (d, missed))
  | ends : f c = Visited None -> turn f used c may missed f used None
  | writes_and_ends : forall g used', writes f used g used' -> g c = Visited None ->
      turn f used c may missed g used' None.

  (** A run of [n] agents: the floor, the labels, where they are, and the turns, the last one first: whose, whether a
      sensor was missed, and where it went. *)
  Definition put (w : nat -> place) (i : nat) (p : place) : nat -> place := fun j => if j =? i then p else w j.
  Definition history : Type := list (nat * bool * option cell).
  Inductive run (n : nat) : floor -> list nat -> (nat -> place) -> history -> Prop :=
  | begins : forall f w, (forall c, f c = Wall \/ f c = Trees.Unexplored cell \/ f c = Trees.Explored cell) ->
      (forall c, f c <> Wall -> In c cells) -> Marking.connected cell beside (accessible f) ->
      (forall i, i < n -> w i <> None) -> run n f [] w []
  | then_ : forall f used w past i c may missed g used' next, run n f used w past -> i < n -> w i = Some (c, may) ->
      turn f used c may missed g used' next ->
      run n g used' (put w i next) ((i, missed, option_map fst next) :: past).
  Definition misses (past : history) : nat := length (filter (fun t => snd (fst t)) past).

  (** Enough turns for [n] agents that miss sensors in [m] turns. *)
  Definition weight_of_place : nat := 2 * length cells + 3.
  Definition enough (n m : nat) : nat :=
    S (n * weight_of_place) * (length cells * (3 + length cells)) + n * weight_of_place + m * S weight_of_place.

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_sym : forall a b, beside a b -> beside b a.
  Hypothesis beside_other : forall a b, beside a b -> a <> b.

  Lemma cell_dec : forall a b : cell, a = b \/ a <> b.
  Proof.
    intros a b; destruct (same a b) eqn:E; [left; now apply same_spec|]. right; intros ->.
    rewrite (proj2 (same_spec b b) eq_refl) in E; discriminate.
  Qed.

  Lemma run_of_trees : forall n f used w past, run n f used w past -> Trees.run cell beside f used.
  Proof.
    assert (forall f used g used', writes f used g used' -> Trees.run cell beside f used ->
      Trees.run cell beside g used')
      as W by (intros f used g used' X; induction X; intros R; (eapply Trees.goes_on; [|eassumption]); auto).
    intros n f used w past R; induction R as [f w S I C A | f used w past i c may missed g used' next R IH L E T];
      [now apply Trees.starts|]. destruct T; auto; eapply W; eauto.
  Qed.

  (** An agent is done when all is visited, and cells stay visited. *)
  Lemma acts_keep : forall f used g used' c e, acts f used g used' -> f c = Visited e -> g c = Visited e.
  Proof.
    intros f used g used' c e A V.
    assert (forall d n, becomes cell f d n g -> f d <> Visited e -> g c = Visited e) as K.
    { intros d n [_ O] N; rewrite O; [exact V|]. intros ->; contradiction. }
    destruct A; try (eapply K; [eassumption | congruence]). eapply K; [eassumption|]. intros X.
    unfold Trees.accessible in H; rewrite X in H; exact H.
  Qed.

  Lemma done_visited : forall n f used w past, run n f used w past -> forall i, i < n -> w i = None ->
    exists c, f c = Visited None.
  Proof.
    assert (forall f used g used' c e, writes f used g used' -> f c = Visited e -> g c = Visited e) as W
      by (intros f used g used' c e X; induction X; intros V; eapply acts_keep; eauto).
    intros n f used w past R; induction R as [f w S I C A | f used w past i c may missed g used' next R IH L E T];
      intros j J N; [destruct (A j J N)|]. unfold put in N; destruct (Nat.eqb_spec j i) as [->|D].
    - destruct T; try discriminate; eauto.
    - destruct (IH j J N) as [x X]. destruct T; eauto.
  Qed.

  (** What is left to be written. *)
  Definition fresh (f : floor) : nat :=
    Ants.sum cell cells (fun c => match f c with Trees.Unexplored _ | Trees.Explored _ => 1 | _ => 0 end).
  Definition above (l : nat) (used : list nat) : nat := length (filter (Nat.ltb l) used).
  Definition weight (a : nat) (used : list nat) (x : note cell) : nat :=
    match x with
    | Trees.Wall _ | Trees.Visited _ _ => 0
    | Trees.Open _ l _ => 1 + a + above l used
    | Trees.Explored _ => 2 + a + length used
    | Trees.Unexplored _ => 3 + a + length used
    end.
  Definition left (f : floor) (used : list nat) : nat := Ants.sum cell cells (fun c => weight (fresh f) used (f c)).

  (** No cell but those of the list is more than a wall. *)
  Definition within (f : floor) : Prop := forall c, f c <> Wall -> In c cells.

  Lemma acts_within : forall f used g used', acts f used g used' -> within f -> within g.
  Proof.
    intros f used g used' A I c N. apply I; intros W.
    assert (forall d n, becomes cell f d n g -> f d <> Wall -> False) as K.
    { intros d n [_ O] D; apply N; rewrite O; [exact W|]. intros ->; contradiction. }
    destruct A; try (eapply K; [eassumption | congruence]). eapply K; [eassumption|]. intros X.
    unfold Trees.accessible in H; rewrite X in H; exact H.
  Qed.

  Lemma filter_most : forall (A : Type) (p : A -> bool) l, length (filter p l) <= length l.
  Proof. intros A p l; induction l as [|x l IH]; cbn; [lia|]. destruct (p x); cbn; lia. Qed.
  Lemma above_most : forall l used, above l used <= length used.
  Proof. intros l used; apply filter_most. Qed.

  Lemma above_less : forall l m used, l < m -> In m used -> above m used < above l used.
  Proof.
    intros l m used L I; apply Frontier.filter_less.
    - intros x X; apply Nat.ltb_lt in X; apply Nat.ltb_lt; lia.
    - exists m; repeat split; [exact I | now apply Nat.ltb_lt | apply Nat.ltb_irrefl].
  Qed.

  Lemma less_left : forall f used g used' c n, within f -> becomes cell f c n g -> f c <> Wall ->
    fresh g + length used' <= fresh f + length used ->
    (forall l, fresh g + above l used' <= fresh f + above l used) ->
    weight (fresh g) used' n < weight (fresh f) used (f c) -> left g used' < left f used.
  Proof.
    intros f used g used' c n I [Gc Go] NW F A L; unfold left; apply Ants.sum_lt.
    - intros d; destruct (cell_dec d c) as [->|D]; [rewrite Gc; lia|]. rewrite (Go d D).
      destruct (f d) as [| | |l q|]; cbn [weight]; try lia. specialize (A l); lia.
    - exists c; split; [now apply I | now rewrite Gc].
  Qed.

  Lemma acts_left : forall f used g used', Trees.run cell beside f used -> within f -> acts f used g used' ->
    left g used' < left f used.
  Proof.
    intros f used g used' R I A. assert (forall c n, becomes cell f c n g ->
      (match n with Trees.Unexplored _ | Trees.Explored _ => 1 | _ => 0 end
        <= match f c with Trees.Unexplored _ | Trees.Explored _ => 1 | _ => 0 end) -> fresh g <= fresh f) as LE.
    { intros c n [Gc Go] H; apply Ants.sum_le. intros d _; destruct (cell_dec d c) as [->|D]; [now rewrite Gc|].
      now rewrite (Go d D). }
    assert (forall c n, becomes cell f c n g -> f c = Trees.Explored cell ->
      (match n with Trees.Unexplored _ | Trees.Explored _ => 1 | _ => 0 end = 0) -> fresh g < fresh f) as LT.
    { intros c n [Gc Go] E Z; apply Ants.sum_lt.
      - intros d; destruct (cell_dec d c) as [->|D]; [rewrite Gc, E, Z; lia | now rewrite (Go d D)].
      - exists c; split; [apply I; congruence|]. rewrite Gc, E, Z; lia. }
    destruct (run_good cell beside cell_dec beside_sym beside_other f used R) as [had [got G]].
    destruct A as [f used c g F B | f used c p m q g F B P H | f used c l r p m q g F B P L H | f used c m g F N H
                  | f used c exit g A M Y X H | f used c m q g F M O H];
      try (assert (fresh g <= fresh f) as Q by (eapply LE; [eassumption | cbn; rewrite ?F; lia]));
      (eapply less_left; [exact I | eassumption | try congruence | try lia | try (intros; lia) | try rewrite F]);
      cbn [weight]; try lia.
    - pose proof (LT _ _ H F eq_refl). pose proof (above_most m used); lia.
    - assert (above m used < above l used); [|lia]. apply above_less; [exact L|].
      apply (had_used _ _ _ _ _ _ G m p), (had_now _ _ _ _ _ _ G p m q P).
    - pose proof (LT _ _ H F eq_refl); cbn [length]; lia.
    - intros l; pose proof (LT _ _ H F eq_refl). unfold above; cbn [filter]; destruct (l <? m); cbn [length]; lia.
    - pose proof (LT _ _ H F eq_refl). unfold above; cbn [filter]; rewrite Nat.ltb_irrefl.
      pose proof (above_most m used); unfold above in *; lia.
    - intros E; unfold Trees.accessible in A; now rewrite E in A.
    - unfold Trees.accessible in A; destruct (f c); cbn; lia || contradiction.
  Qed.

  (** When each cell was last written: a child of a tree after its parent, a visited cell before the one it leads to. *)
  Record stamped (f : floor) (s : cell -> nat) (now : nat) : Prop := {
    sooner : forall c l p q, f c = Open l (Some p) -> f p = Open l q -> s p < s c;
    later : forall c e x, f c = Visited (Some e) -> f e = Visited x -> s c < s e;
    before : forall c, s c < now;
    no_wall : forall c e, f c = Visited (Some e) -> f e <> Wall;
  }.

  Lemma acts_stamped : forall f used g used' s now, Trees.run cell beside f used -> acts f used g used' ->
    stamped f s now -> exists s', stamped g s' (S now).
  Proof.
    intros f used g used' s now R A [S1 S2 S3 S4].
    destruct (run_good cell beside cell_dec beside_sym beside_other f used R) as [had [got G]].
    assert (forall c n, becomes cell f c n g -> f c <> Wall -> n <> Wall -> (forall e, f c <> Visited e) ->
      (forall m, match n with Trees.Open _ l _ => l = m | _ => False end -> forall d, f d <> Open m (Some c)) ->
      (forall m p, n = Open m (Some p) -> p <> c) ->
      (forall e, n = Visited (Some e) -> e <> c /\ accessible f e) -> exists s', stamped g s' (S now)) as K.
    { intros c n [Gc Go] NW NN NV CH PA EX. exists (fun d => if same d c then now else s d).
      assert (forall d, same d c = false -> d <> c) as NE
        by (intros d D ->; rewrite (proj2 (same_spec c c) eq_refl) in D; discriminate).
      assert (forall d, f d <> Wall -> g d <> Wall) as GW
        by (intros d D; destruct (cell_dec d c) as [->|X]; [now rewrite Gc | now rewrite (Go d X)]).
      split.
      - intros a l p q Fa Fp. destruct (same p c) eqn:Ep, (same a c) eqn:Ea;
          try (apply same_spec in Ep; subst p); try (apply same_spec in Ea; subst a).
        + exfalso; rewrite Gc in Fa; now apply (PA _ _ Fa).
        + exfalso; rewrite (Go a (NE a Ea)) in Fa. rewrite Gc in Fp; apply (CH l) with a; [now rewrite Fp | exact Fa].
        + apply S3.
        + rewrite (Go a (NE a Ea)) in Fa; rewrite (Go p (NE p Ep)) in Fp; eauto.
      - intros a e x Fa Fe. destruct (same e c) eqn:Ee, (same a c) eqn:Ea;
          try (apply same_spec in Ee; subst e); try (apply same_spec in Ea; subst a).
        + exfalso; rewrite Gc in Fa; now apply (EX _ Fa).
        + apply S3.
        + exfalso; rewrite Gc in Fa; destruct (EX _ Fa) as [_ Y]. rewrite (Go e (NE e Ee)) in Fe.
          unfold Trees.accessible in Y; now rewrite Fe in Y.
        + rewrite (Go a (NE a Ea)) in Fa; rewrite (Go e (NE e Ee)) in Fe; eauto.
      - intros a; destruct (same a c); [lia | pose proof (S3 a); lia].
      - intros a e Fa; apply GW; destruct (cell_dec a c) as [->|X].
        + rewrite Gc in Fa; destruct (EX _ Fa) as [_ Y]; intros Z; unfold Trees.accessible in Y; now rewrite Z in Y.
        + rewrite (Go a X) in Fa; eauto. }
    assert (forall c m d, (forall l r, f c = Open l r -> l < m) -> accessible f c -> f d <> Open m (Some c)) as NC.
    { intros c m d H A' E. pose proof (parent_got _ _ _ _ _ _ G d m c E) as X.
      destruct (had_open _ _ _ _ _ _ G m c (proj2 (got_had _ _ _ _ _ _ G _ _ _ X)) A') as [l [q [F L]]].
      specialize (H l q F); lia. }
    assert (forall c, f c = Trees.Explored cell -> accessible f c) as AE
      by (intros c F; unfold Trees.accessible; now rewrite F).
    destruct A as [f used c g F B | f used c p m q g F B P H | f used c l r p m q g F B P L H | f used c m g F N H
                  | f used c exit g A M Y X H | f used c m q g F M O H]; (eapply K; [eassumption | | | | | |]);
      try congruence; try (intros ? []; fail).
    - intros k <-; intros d; apply NC; [congruence | auto].
    - intros k <-; intros d; apply NC; [|unfold Trees.accessible; now rewrite F]. intros l' r' E.
      rewrite F in E; injection E as <- _; exact L.
    - intros k p' E; injection E as <- <-. intros ->; now apply (beside_other c c).
    - intros k <-; intros d; apply NC; [congruence | auto].
    - intros E; unfold Trees.accessible in A; now rewrite E in A.
    - intros e E; unfold Trees.accessible in A; now rewrite E in A.
    - intros e E; injection E as ->. destruct X as [X1 X2]; split; [|exact X2]. intros ->; now apply (beside_other c c).
    - intros e E; injection E as ->. split; [|exact (parent_left _ _ _ _ _ _ G c m e F)].
      intros ->. apply (beside_other c c); [|reflexivity].
      exact (got_beside _ _ _ _ _ _ G _ _ _ (parent_got _ _ _ _ _ _ G c m c F)).
  Qed.

  (** How many cells are ahead of an agent that writes nothing. *)
  Definition key (s : cell -> nat) (f : floor) (c : cell) : nat * nat :=
    match f c with
    | Trees.Visited _ _ => (0, s c)
    | Trees.Open _ l _ => (2 + l, s c)
    | _ => (1, 0)
    end.
  Definition after (s : cell -> nat) (f : floor) (c d : cell) : bool :=
    (fst (key s f c) <? fst (key s f d))
    || (fst (key s f c) =? fst (key s f d)) && (snd (key s f c) <? snd (key s f d)).
  Definition ahead (s : cell -> nat) (f : floor) (c : cell) : nat := length (filter (after s f c) cells).

  Lemma after_spec : forall s f c d, after s f c d = true <-> fst (key s f c) < fst (key s f d)
    \/ fst (key s f c) = fst (key s f d) /\ snd (key s f c) < snd (key s f d).
  Proof. intros; unfold after; rewrite orb_true_iff, andb_true_iff, Nat.ltb_lt, Nat.eqb_eq, Nat.ltb_lt; tauto. Qed.

  Lemma walks_ahead : forall f s now c d, within f -> stamped f s now -> walks f c d ->
    ahead s f d < ahead s f c.
  Proof.
    intros f s now c d I [S1 S2 S3 S4] W.
    assert (after s f c d = true /\ f d <> Wall) as [A NW].
    { rewrite after_spec; unfold key. destruct W as [m q F E | l q m r F E L | e F A | F]; rewrite F.
      - rewrite E; split; [|congruence]. right; cbn; split; [reflexivity | eauto].
      - rewrite E; split; [cbn; lia | congruence].
      - unfold Trees.accessible in A; destruct (f d); cbn; try contradiction; (split; [lia | congruence]).
      - split; [|eauto]. destruct (f d) eqn:E; cbn; try lia. right; split; [reflexivity | eauto]. }
    apply Frontier.filter_less.
    - intros x X; apply after_spec in X, A; apply after_spec; lia.
    - exists d; repeat split; [now apply I | exact A|]. destruct (after s f d d) eqn:Z; [|reflexivity].
      apply after_spec in Z; lia.
  Qed.

  Definition rank (s : cell -> nat) (f : floor) (p : place) : nat :=
    match p with
    | None => 0
    | Some (c, may) => 1 + ahead s f c + if may then 2 + length cells else 0
    end.
  Lemma rank_most : forall s f p, rank s f p <= weight_of_place.
  Proof.
    intros s f [[c may]|]; unfold rank, weight_of_place; [|lia]. pose proof (filter_most _ (after s f c) cells).
    unfold ahead; destruct may; lia.
  Qed.

  Lemma total_other : forall n f g j, j < n -> (forall i, i <> j -> g i = f i) ->
    Frontier.total n g + f j = Frontier.total n f + g j.
  Proof.
    induction n as [|n IH]; intros f g j L S; [lia|]. rewrite !Frontier.total_S.
    destruct (Nat.eq_dec n j) as [->|NE].
    - assert (forall m, m <= j -> Frontier.total m g = Frontier.total m f) as H; [|rewrite H; lia].
      induction m as [|m IHm]; intros L'; [reflexivity|]. rewrite !Frontier.total_S, IHm, S by lia; reflexivity.
    - rewrite (S n NE). specialize (IH f g j ltac:(lia) S); lia.
  Qed.

  Lemma writes_left : forall f used g used', writes f used g used' -> Trees.run cell beside f used -> within f ->
    forall s now, stamped f s now -> Trees.run cell beside g used' /\ within g /\ left g used' < left f used
      /\ exists s' now', stamped g s' now'.
  Proof.
    intros f used g used' W; induction W as [g used' A | g used' h used'' W IH A]; intros R I s now S.
    - split; [eapply Trees.goes_on; eauto|]. split; [eapply acts_within; eauto|]. split; [now apply acts_left|].
      destruct (acts_stamped _ _ _ _ _ _ R A S); eauto.
    - destruct (IH R I s now S) as [R' [I' [L [s' [now' S']]]]]. split; [eapply Trees.goes_on; eauto|].
      split; [eapply acts_within; eauto|]. split; [pose proof (acts_left _ _ _ _ R' I' A); lia|].
      destruct (acts_stamped _ _ _ _ _ _ R' A S'); eauto.
  Qed.

  Lemma run_within : forall n f used w past, run n f used w past -> within f.
  Proof.
    assert (forall f used g used', writes f used g used' -> within f -> within g) as W
      by (intros f used g used' X; induction X; intros I; eapply acts_within; eauto).
    intros n f used w past R; induction R as [f w S I C A | f used w past i c may missed g used' next R IH L E T];
      [exact I|]. destruct T; auto; eapply W; eauto.
  Qed.

  Lemma turns_are_few : forall n f used w past, run n f used w past ->
    exists s now, stamped f s now /\ length past + S (n * weight_of_place) * left f used
      + Frontier.total n (fun i => rank s f (w i)) <= enough n (misses past).
  Proof.
    intros n f used w past R; induction R as [f w F I C A | f used w past i c may missed g used' next R IH L E T].
    { exists (fun _ => 0), 1; split.
      - split; intros; try lia; destruct (F c) as [X|[X|X]]; congruence.
      - assert (left f [] <= length cells * (3 + length cells)) as B.
        { apply Ants.sum_most; intros d _.
          assert (fresh f <= length cells) by (rewrite <- Nat.mul_1_r; apply Ants.sum_most; intros x _;
            destruct (f x); lia).
          destruct (f d); cbn [weight above filter length]; lia. }
        pose proof (Frontier.total_most n (fun i => rank (fun _ => 0) f (w i)) weight_of_place
          (fun i _ => rank_most _ _ _)).
        unfold enough; cbn [length misses filter]. nia. }
    destruct IH as [s [now [ST B]]]. pose proof (run_of_trees _ _ _ _ _ R) as RT.
    pose proof (run_within _ _ _ _ _ R) as RI.
    assert (enough n (misses ((i, missed, option_map fst next) :: past))
      = enough n (misses past) + if missed then Datatypes.S weight_of_place else 0) as EN.
    { unfold enough, misses; cbn [filter fst snd]; destruct missed; cbn [length]; lia. }
    assert (forall s' p, Frontier.total n (fun j => rank s' f (put w i p j)) + rank s' f (w i)
      = Frontier.total n (fun j => rank s' f (w j)) + rank s' f p) as TO.
    { intros s' p. rewrite (total_other n (fun j => rank s' f (w j)) _ i L).
      - unfold put at 1; now rewrite Nat.eqb_refl.
      - intros j J; unfold put; now rewrite (proj2 (Nat.eqb_neq j i) J). }
    assert (forall p, writes f used g used' -> exists s' now', stamped g s' now' /\
      S (length past) + S (n * weight_of_place) * left g used' + Frontier.total n (fun j => rank s' g (put w i p j))
        <= enough n (misses past)) as WR.
    { intros p W; destruct (writes_left _ _ _ _ W RT RI s now ST) as [_ [_ [LL [s' [now' S']]]]].
      exists s', now'; split; [exact S'|].
      pose proof (Frontier.total_most n (fun j => rank s' g (put w i p j)) weight_of_place
        (fun j _ => rank_most _ _ _)). nia. }
    rewrite EN; cbn [length]. destruct T as [g used' d W | d W | d M | V | g used' W V];
      try (destruct (WR (Some (d, true)) W) as [s' [now' [S' B']]]; exists s', now'; split; [exact S' | lia]);
      try (destruct (WR None W) as [s' [now' [S' B']]]; exists s', now'; split; [exact S' | lia]);
      exists s, now; (split; [exact ST|]).
    - specialize (TO s (Some (d, missed))). pose proof (walks_ahead _ _ _ _ _ RI ST W) as LA.
      pose proof (rank_most s f (Some (d, missed))). rewrite E in TO; cbn [rank] in TO.
      destruct missed; destruct may; cbn [rank] in *; lia.
    - specialize (TO s (Some (d, missed))). pose proof (rank_most s f (Some (d, missed))).
      pose proof (filter_most _ (after s f d) cells) as LA. fold (ahead s f d) in LA. rewrite E in TO.
      destruct missed; destruct may; try discriminate; cbn [rank] in *; lia.
    - specialize (TO s None). rewrite E in TO; cbn [rank] in TO. destruct missed; lia.
  Qed.
  Lemma ended : forall n f used w past, run n f used w past -> forall i, i < n -> w i = None ->
    forall d, f d = Wall \/ exists exit, f d = Visited exit.
  Proof.
    intros n f used w past R i L N d. destruct (done_visited _ _ _ _ _ R i L N) as [c C].
    exact (Trees.BRICKS_4 cell beside cell_dec beside_sym beside_other f used (run_of_trees _ _ _ _ _ R) c C d).
  Qed.
End Ends.

(** Cells can be told apart, each is beside those that are beside it, and none is beside itself. *)
Definition is_floor (cell : Type) (same : cell -> cell -> bool) (beside : cell -> cell -> Prop) : Prop :=
  (forall a b, same a b = true <-> a = b) /\ (forall a b, beside a b -> beside b a)
  /\ (forall a b, beside a b -> a <> b).

(** A run has a stated number of turns at most, more if sensors are missed; when an agent is done, every cell is
    visited. *)
Theorem BRICKS_6 : forall cell same beside cells, is_floor cell same beside ->
  forall n f used w past, run cell beside cells n f used w past ->
  length past <= enough cell cells n (misses cell past)
  /\ (forall i, i < n -> w i = None -> forall d, f d = Wall cell \/ exists exit, f d = Visited cell exit).
Proof.
  intros cell same beside cells [E [S O]] n f used w past R; split.
  - destruct (turns_are_few cell same beside cells E S O n f used w past R) as [s [now [_ B]]]; lia.
  - intros i L N; eapply ended; eauto.
Qed.

(** Until an agent is done, there are finitely many turns; then every cell is explored. *)
Theorem BRICKS_5 : forall cell same beside cells, is_floor cell same beside ->
  forall n f used w past, run cell beside cells n f used w past -> forall i, i < n ->
  match w i with
  | Some _ => length past <= enough cell cells n (misses cell past)
  | None => forall d, f d <> Unexplored cell
  end.
Proof.
  intros cell same beside cells [E [S O]] n f used w past R i L.
  destruct (BRICKS_6 cell same beside cells (conj E (conj S O)) n f used w past R) as [B D].
  destruct (w i) eqn:W; [exact B|].
  intros d; destruct (D i L W d) as [X|[e X]]; congruence.
Qed.

(** How many turns an agent has had. *)
Definition turns_of {cell : Type} (i : nat) (past : history cell) : nat :=
  length (filter (fun t => fst (fst t) =? i) past).

(** However many of the others have failed, an agent has a stated number of turns at most, and when it is done every
    cell is visited. *)
Theorem BRICKS_11 : forall cell same beside cells, is_floor cell same beside ->
  forall n f used w past, run cell beside cells n f used w past -> forall i, i < n ->
  turns_of i past <= enough cell cells n (misses cell past)
  /\ (w i = None -> forall d, f d = Wall cell \/ exists exit, f d = Visited cell exit).
Proof.
  intros cell same beside cells [E [S O]] n f used w past R i L.
  destruct (BRICKS_6 cell same beside cells (conj E (conj S O)) n f used w past R) as [B D]. split; [|eauto].
  pose proof (filter_most _ (fun t => fst (fst t) =? i) past); unfold turns_of; lia.
Qed.

(** What is needed: if a cell that is marked did not say where more is left, an agent would be done before another cell is
    explored. *)
Theorem without_Exit_breaks_BRICKS_6 : exists f w g, run nat in_a_row [0; 1; 2] 1 f [] w [] /\ w 0 = Some (0, false)
  /\ accessible nat f 0 /\ may_mark nat in_a_row f 0 /\ bypassed nat in_a_row f 0
  /\ becomes nat f 0 (Visited nat None) g /\ g 1 = Unexplored nat.
Proof.
  set (f := fun c => match c with 0 => Explored nat | 1 | 2 => Unexplored nat | _ => Wall nat end).
  exists f, (fun _ => Some (0, false)), (Trees.put f 0 (Visited nat None)).
  assert (forall c, accessible nat f c -> c < 3) as A by (intros [|[|[|c]]] X; try lia; destruct X).
  split; [|split; [reflexivity|]]; [|split; [exact I|]].
  - apply begins; [intros [|[|[|c]]]; cbn; auto | intros [|[|[|c]]] N; cbn in *; tauto | | discriminate].
    intros a b Fa Fb; assert (forall c, c < 3 -> Marking.way nat in_a_row (accessible nat f) c 1
      /\ Marking.way nat in_a_row (accessible nat f) 1 c) as W.
    { intros [|[|[|c]]] L; try lia; split; try (constructor; exact I).
      all: eapply Marking.onward; [exact I | | constructor; exact I]; unfold in_a_row; lia. }
    eapply Marking.way_trans; [apply W, A, Fa | apply W, A, Fb].
  - assert (forall d l q, f d <> Open nat l q) as N by (intros [|[|[|d]]] l q; discriminate).
    split; [split; intros; [apply N | exfalso; eapply N; eauto]|].
    split; [|split; [apply Trees.put_becomes | reflexivity]].
    intros a b [Fa _] [Fb _] Ba Bb. unfold in_a_row in Ba, Bb. assert (a = 1 /\ b = 1) as [-> ->] by lia.
    apply Marking.here; split; [exact I | lia].
Qed.
