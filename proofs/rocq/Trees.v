(** Trees on a floor without missed sensors, brick-tree and helpers: BRICKS-2, 4, 8 and 9, for every number of agents,
    every floor and every order of actions. A cell joins the tree of a cell beside it, is made a child by a tree with a
    greater label, founds a tree, or is marked. TreesTie.v compares the kernel's runs. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Marking.
Import ListNotations.

Section Trees.
  Variables (cell : Type) (beside : cell -> cell -> Prop).

  (** The sensor of a cell: of an open one the label of its tree, and its parent; of a visited one where more was left.
      What is no cell of the floor is a wall. *)
  Inductive note :=
  | Wall
  | Unexplored
  | Explored
  | Open (label : nat) (parent : option cell)
  | Visited (exit : option cell).
  Definition floor : Type := cell -> note.
  Definition accessible (f : floor) (c : cell) : Prop := match f c with Wall | Visited _ => False | _ => True end.
  Definition is_open (f : floor) (c : cell) : Prop := exists l q, f c = Open l q.
  Definition becomes (f : floor) (c : cell) (n : note) (g : floor) : Prop := g c = n /\ forall d, d <> c -> g d = f d.

  (** The accessible cells beside [c] are connected with each other without it: what BRICKS-1 shows of one that does not
      block. *)
  Definition bypassed (f : floor) (c : cell) : Prop :=
    forall a b, Marking.unmarked cell (accessible f) c a -> Marking.unmarked cell (accessible f) c b ->
      beside a c -> beside c b -> Marking.way cell beside (Marking.unmarked cell (accessible f) c) a b.

  (** A cell may be marked: it has no child, and is of the same tree as all cells of trees beside it. *)
  Definition may_mark (f : floor) (c : cell) : Prop :=
    (forall d l, beside c d -> f d <> Open l (Some c))
    /\ (forall m q d l r, f c = Open m q -> beside c d -> f d = Open l r -> l = m).

  (** What may come of a floor, and of the labels that have been given. *)
  Inductive acts : floor -> list nat -> floor -> list nat -> Prop :=
  | enters : forall f used c g, f c = Unexplored -> becomes f c Explored g -> acts f used g used
  | joins : forall f used c p m q g, f c = Explored -> beside c p -> f p = Open m q ->
      becomes f c (Open m (Some p)) g -> acts f used g used
  | adopted : forall f used c l r p m q g, f c = Open l r -> beside c p -> f p = Open m q -> l < m ->
      becomes f c (Open m (Some p)) g -> acts f used g used
  | founds : forall f used c m g, f c = Explored -> ~ In m used -> becomes f c (Open m None) g ->
      acts f used g (m :: used)
  | marks_brick : forall f used c exit g, accessible f c -> may_mark f c -> bypassed f c ->
      match exit with Some e => beside c e /\ accessible f e | None => forall d, beside c d -> ~ accessible f d end ->
      becomes f c (Visited exit) g -> acts f used g used
  | marks_leaf : forall f used c m q g, f c = Open m q -> may_mark f c ->
      (forall d, beside c d -> accessible f d -> is_open f d) -> becomes f c (Visited q) g -> acts f used g used.

  (** Runs from a connected floor on which no agent has been but where agents start. *)
  Inductive run : floor -> list nat -> Prop :=
  | starts : forall f, (forall c, f c = Wall \/ f c = Unexplored \/ f c = Explored) ->
      Marking.connected cell beside (accessible f) -> run f []
  | goes_on : forall f used g used', run f used -> acts f used g used' -> run g used'.

  Hypothesis cell_dec : forall a b : cell, a = b \/ a <> b.
  Hypothesis beside_sym : forall a b, beside a b -> beside b a.
  Hypothesis beside_other : forall a b, beside a b -> a <> b.

  (** [had k c]: the cell has ever had the label. [got k c p]: it got it from [p]. *)
  Section Ways.
    Variables (f : floor) (got : nat -> cell -> cell -> Prop).
    Definition linked (m : nat) (a b : cell) : Prop := exists k, m <= k /\ (got k a b \/ got k b a).
    Inductive path (m : nat) (a : cell) : cell -> Prop :=
    | path_here : accessible f a -> path m a a
    | path_on : forall b c, path m a b -> linked m b c -> accessible f c -> path m a c.

    Lemma linked_sym : forall m a b, linked m a b -> linked m b a.
    Proof. intros m a b [k [L G]]; exists k; tauto. Qed.
    Lemma path_starts : forall m a b, path m a b -> accessible f a.
    Proof. intros m a b P; induction P; auto. Qed.
    Lemma path_ends : forall m a b, path m a b -> accessible f b.
    Proof. intros m a b P; destruct P; auto. Qed.
    Lemma path_trans : forall m a b c, path m a b -> path m b c -> path m a c.
    Proof. intros m a b c P Q; induction Q; [exact P | eapply path_on; eauto]. Qed.
    Lemma path_sym : forall m a b, path m a b -> path m b a.
    Proof.
      intros m a b P; induction P as [A | b c P IH L A]; [now constructor|].
      eapply path_trans; [|exact IH]. eapply path_on; [now constructor | now apply linked_sym|].
        now apply path_ends in P.
    Qed.
  End Ways.

  Lemma path_mono : forall f g (got got' : nat -> cell -> cell -> Prop) m n a b, (forall c, accessible f c ->
    accessible g c) ->
    (forall k c p, got k c p -> got' k c p) -> n <= m -> path f got m a b -> path g got' n a b.
  Proof.
    intros f g got got' m n a b F G L P; induction P as [A | b c P IH [k [K E]] A]; [constructor; auto|].
    eapply path_on; [exact IH | | auto]. exists k; split; [lia|]. destruct E; auto.
  Qed.

  Record good (f : floor) (used : list nat) (had : nat -> cell -> Prop) (got : nat -> cell -> cell -> Prop) : Prop := {
    had_open : forall k c, had k c -> accessible f c -> exists l q, f c = Open l q /\ k <= l;
    had_now : forall c l q, f c = Open l q -> had l c;
    had_used : forall k c, had k c -> In k used;
    got_had : forall k c p, got k c p -> had k c /\ had k p;
    got_beside : forall k c p, got k c p -> beside c p;
    got_parent : forall k c p q, got k c p -> f c = Open k q -> q = Some p;
    parent_got : forall c l p, f c = Open l (Some p) -> got l c p;
    parent_left : forall c l p, f c = Open l (Some p) -> accessible f p;
    paths : forall m a b, had m a -> had m b -> accessible f a -> accessible f b -> path f got m a b;
    left_connected : Marking.connected cell beside (accessible f);
    none_left : forall c, f c = Visited None -> forall d, ~ accessible f d;
  }.

  (** A cell that was none of a tree, or of one with a lower label, is opened. *)
  Lemma opens : forall f used had got c m par g used',
    good f used had got -> accessible f c -> (f c = Explored \/ exists l r, f c = Open l r /\ l < m) ->
    match par with
    | Some p => beside c p /\ (exists q, f p = Open m q) /\ used' = used
    | None => ~ In m used /\ used' = m :: used
    end ->
    becomes f c (Open m par) g ->
    good g used' (fun k d => had k d \/ (k = m /\ d = c)) (fun k d p => got k d p \/ (k = m /\ d = c /\ par = Some p)).
  Proof.
    intros f used had got c m par g used' [I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11] A NEW PAR [Gc Go].
    assert (forall d, accessible g d <-> accessible f d) as AC.
    { intros d; destruct (cell_dec d c) as [->|D]; [|unfold accessible; now rewrite (Go d D)].
      unfold accessible at 1; rewrite Gc; tauto. }
    assert (~ had m c) as NH.
    { intros H; destruct (I1 m c H A) as [l [q [E L]]]. destruct NEW as [N|[l' [r [N L']]]]; rewrite N in E;
        [discriminate | injection E; lia]. }
    assert (forall p, par = Some p -> had m p /\ accessible f p /\ beside c p) as P.
    { intros p ->; destruct PAR as [B [[q E] _]]. split; [now apply I2 with q|]. split; [|exact B].
      unfold accessible; now rewrite E. }
    assert (forall m0 a b, path f got m0 a b ->
      path g (fun k d p => got k d p \/ (k = m /\ d = c /\ par = Some p)) m0 a b)
      as PM by (intros; eapply path_mono; [apply AC | | apply le_n | eassumption]; auto).
    split.
    - intros k d H B; apply AC in B. destruct (cell_dec d c) as [->|D].
      + rewrite Gc; exists m, par; split; [reflexivity|]. destruct H as [H|[-> _]]; [|lia].
        destruct (I1 k c H A) as [l [q [E L]]]. destruct NEW as [N|[l' [r [N L']]]]; rewrite N in E;
          [discriminate | injection E; lia].
      + rewrite (Go d D); destruct H as [H|[_ H]]; [auto | contradiction].
    - intros d l q E; destruct (cell_dec d c) as [->|D]; [rewrite Gc in E; injection E as <- <-; auto|].
      rewrite (Go d D) in E; left; eauto.
    - intros k d H. assert (In k used \/ k = m) as [J|J] by (destruct H as [H|[-> _]]; [left; eauto | auto]).
      + destruct par; destruct PAR as [? ?]; [destruct H1 as [_ ->] | subst]; cbn; auto.
      + subst k; destruct par as [p|]; [|destruct PAR as [_ ->]; now left].
        destruct PAR as [_ [_ ->]]. apply I3 with p. now apply P.
    - intros k d p [H|[-> [-> E]]]; [destruct (I4 _ _ _ H); auto|]. destruct (P p E); auto.
    - intros k d p [H|[-> [-> E]]]; [eauto|]. now destruct (P p E).
    - intros k d p q [H|[-> [-> E]]] F.
      + destruct (cell_dec d c) as [->|D]; [|rewrite (Go d D) in F; eauto].
        rewrite Gc in F; injection F as <- <-. destruct NH; now apply (I4 m c p).
      + rewrite Gc in F; injection F as <-; exact E.
    - intros d l p F; destruct (cell_dec d c) as [->|D]; [rewrite Gc in F; injection F as <- ->; auto|].
      rewrite (Go d D) in F; auto.
    - intros d l p F; apply AC. destruct (cell_dec d c) as [->|D]; [|rewrite (Go d D) in F; eauto].
      rewrite Gc in F; injection F as <- ->. now apply P.
    - assert (forall a, had m a -> accessible f a ->
        path g (fun k d p => got k d p \/ (k = m /\ d = c /\ par = Some p)) m a c) as NEWPATH.
      { intros a H B. destruct par as [p|]; [|destruct PAR as [N _]; destruct N; eauto].
        destruct (P p eq_refl) as [Hp [Ap _]]. eapply path_on; [apply PM, I9; [exact H | exact Hp | exact B |
          exact Ap] | |].
        - exists m; split; [lia|]. right; right; auto.
        - now apply AC. }
      intros m0 a b [Ha|[-> ->]] [Hb|[E ->]] Aa Ab; [apply PM, I9; auto; now apply AC | subst m0 | | constructor;
        exact Aa].
      + apply NEWPATH; [exact Ha | now apply AC].
      + apply path_sym, NEWPATH; [exact Hb | now apply AC].
    - intros a b Aa Ab. eapply Marking.way_same; [intros d; apply AC|]. apply I10; now apply AC.
    - intros d F e E. destruct (cell_dec d c) as [->|D]; [rewrite Gc in F; discriminate|].
      rewrite (Go d D) in F; apply (I11 d F e); now apply AC.
  Qed.

  (** A cell is marked. *)
  Lemma is_marked : forall f used had got c exit g,
    good f used had got -> accessible f c -> may_mark f c ->
    bypassed f c \/ (exists m, f c = Open m exit /\ forall d, beside c d -> accessible f d -> is_open f d) ->
    (exit = None -> (forall d, beside c d -> ~ accessible f d) \/ exists m, f c = Open m None
      /\ forall d, beside c d -> accessible f d -> is_open f d) ->
    becomes f c (Visited exit) g -> good g used had got.
  Proof.
    intros f used had got c exit g [I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11] A [CH OL] HOW EX [Gc Go].
    assert (forall d, accessible g d <-> Marking.unmarked cell (accessible f) c d) as AC.
    { intros d; unfold Marking.unmarked; destruct (cell_dec d c) as [->|D].
      - unfold accessible at 1; rewrite Gc; tauto.
      - unfold accessible; rewrite (Go d D); tauto. }
    assert (forall d, accessible g d -> accessible f d /\ d <> c) as AG by (intros d D; now apply AC in D).
    (* what is linked with it *)
    assert (forall k x, linked got k c x -> accessible f x -> exists m q, f c = Open m q /\ had m x /\ k <= m
      /\ (m <= k -> q = Some x)) as LK.
    { intros k x [j [J [E|E]]] X; destruct (I4 _ _ _ E) as [H1 H2].
      - destruct (I1 _ _ H1 A) as [m [q [Fc L]]]; destruct (I1 _ _ H2 X) as [l [r [Fx L']]].
        assert (l = m) as -> by (eapply OL; eauto). exists m, q. repeat split; eauto; [lia|].
        intros Y; assert (j = m) as -> by lia; eauto.
      - destruct (I1 _ _ H2 A) as [m [q [Fc L]]]; destruct (I1 _ _ H1 X) as [l [r [Fx L']]].
        assert (l = m) as -> by (eapply OL; eauto). exists m, q. repeat split; eauto; [lia|].
        intros Y; exfalso; assert (j = m) as -> by lia.
        pose proof (I6 _ _ _ _ E Fx) as ->. apply (CH x m); [apply beside_sym; eauto | exact Fx]. }
    assert (forall k, (forall x y, accessible g x -> accessible g y -> linked got k c x -> linked got k c y ->
        path g got k x y) -> forall a b, path f got k a b -> a <> c ->
        (b <> c -> path g got k a b) /\ (b = c -> exists x, path g got k a x /\ linked got k c x)) as AVOID.
    { intros k H a b P Na; induction P as [Aa | b d P [IH1 IH2] L Ad].
      - split; [intros _; constructor; apply AC; split; auto | intros E; contradiction].
      - split.
        + intros Nd; destruct (cell_dec b c) as [->|Nb].
          * destruct (IH2 eq_refl) as [x [Px Lx]]. eapply path_trans; [exact Px|].
            apply H; auto; [now apply path_ends in Px | apply AC; split; auto].
          * eapply path_on; [now apply IH1 | exact L | apply AC; split; auto].
        + intros ->; destruct (cell_dec b c) as [->|Nb]; [auto|]. exists b; split; [auto | now apply linked_sym]. }
    assert (forall k x y, accessible g x -> accessible g y -> linked got k c x -> linked got k c y -> path g got k x y)
      as ROUND.
    { assert (forall m q, f c = Open m q -> forall x y, accessible g x -> accessible g y -> linked got m c x ->
        linked got m c y -> path g got m x y) as TOP.
      { intros m q F x y X Y LX LY. destruct (LK m x LX) as [m' [q' [F' [_ [_ E]]]]]; [now apply AG|].
        destruct (LK m y LY) as [m'' [q'' [F'' [_ [_ E']]]]]; [now apply AG|].
        rewrite F in F', F''; injection F' as <- <-; injection F'' as <- <-.
        rewrite E in E' by lia. injection (E' ltac:(lia)) as ->. now constructor. }
      intros k x y X Y LX LY. destruct (LK k x LX) as [m [q [F [Hx [K _]]]]]; [now apply AG|].
      destruct (LK k y LY) as [m' [q' [F' [Hy _]]]]; [now apply AG|]. rewrite F in F'; injection F' as <- <-.
      destruct (AG x X) as [Ax Nx], (AG y Y) as [Ay Ny].
      eapply path_mono with (m := m); [intros z Z; exact Z | intros ? ? ? Z; exact Z | exact K|].
      apply (AVOID m (TOP m q F) x y); auto. }
    assert (forall m a b, had m a -> had m b -> accessible g a -> accessible g b -> path g got m a b) as PATHS.
    { intros m a b Ha Hb Aa Ab; destruct (AG a Aa) as [Ba Na], (AG b Ab) as [Bb Nb].
      apply (AVOID m (ROUND m) a b); auto. }
    split; auto.
    - intros k d H B; destruct (AG d B) as [B' D]; rewrite (Go d D); auto.
    - intros d l q E; destruct (cell_dec d c) as [->|D]; [rewrite Gc in E; discriminate | rewrite (Go d D) in E; eauto].
    - intros k d p q H F; destruct (cell_dec d c) as [->|D]; [rewrite Gc in F; discriminate | rewrite (Go d D) in F;
      eauto].
    - intros d l p F; destruct (cell_dec d c) as [->|D]; [rewrite Gc in F; discriminate | rewrite (Go d D) in F; auto].
    - intros d l p F; destruct (cell_dec d c) as [->|D]; [rewrite Gc in F; discriminate|]. rewrite (Go d D) in F.
      apply AC; split; [eauto|]. intros ->. apply (CH d l); [apply beside_sym; eauto | exact F].
    - intros a b Aa Ab. eapply Marking.way_same; [exact AC|]. apply AC in Aa, Ab.
      apply Marking.marking_keeps_connected; auto. destruct HOW as [B|[m [F O]]]; [exact B|].
      intros x y X Y BX BY. assert (forall z, beside c z -> accessible f z -> had m z) as HM.
      { intros z B Z; destruct (O z B Z) as [l [r E]]. assert (l = m) as -> by (eapply OL; eauto). eauto. }
      assert (path g got m x y) as P.
      { apply PATHS; [apply HM; auto; apply X | apply HM; auto; apply Y | now apply AC | now apply AC]. }
      clear - P AC I5 beside_sym. eapply Marking.way_same; [intros d; symmetry; apply AC|].
      enough (Marking.way cell beside (accessible g) x y) as W.
      { eapply Marking.way_same; [|exact W]. intros d; reflexivity. }
      induction P as [Ax | y z P IH [k [_ E]] Az]; [now constructor|]. eapply Marking.way_trans; [exact IH|].
      eapply Marking.onward; [now apply path_ends in P | | now constructor]. destruct E; [eauto | apply beside_sym;
        eauto].
    - intros d F e E. destruct (cell_dec d c) as [->|D].
      2: { rewrite (Go d D) in F; apply (I11 d F e); now apply AG. }
      rewrite Gc in F; injection F as ->. destruct (AG e E) as [Ae Ne].
      assert (exists x, beside c x /\ accessible f x) as [x [B X]].
      { destruct (I10 c e A Ae) as [|? n ? _ B W]; [contradiction|]. exists n; split; [exact B|]. now destruct W. }
      destruct (EX eq_refl) as [N|[m [Fc O]]]; [now apply (N x)|].
      destruct (O x B X) as [l [r Fx]]. assert (l = m) as -> by (eapply OL; eauto).
      assert (forall y, path f got m c y -> y = c) as ALONE.
      { intros y P; induction P as [|b d P IH L Ad]; [reflexivity|]. subst b.
        destruct (LK m d L Ad) as [m' [q [F [_ [_ H]]]]]. rewrite Fc in F; injection F as <- <-.
          discriminate (H ltac:(lia)). }
      apply (beside_other _ _ B). symmetry; apply ALONE, I9; eauto.
  Qed.

  (** A cell is entered for the first time. *)
  Lemma is_entered : forall f used had got c g, good f used had got -> f c = Unexplored -> becomes f c Explored g ->
    good g used had got.
  Proof.
    intros f used had got c g [I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11] F [Gc Go].
    assert (forall d, accessible g d <-> accessible f d) as AC.
    { intros d; unfold accessible; destruct (cell_dec d c) as [->|D]; [now rewrite Gc, F | now rewrite (Go d D)]. }
    assert (forall d l q, g d = Open l q -> f d = Open l q) as O.
    { intros d l q E; destruct (cell_dec d c) as [->|D]; [rewrite Gc in E; discriminate | now rewrite <- (Go d D)]. }
    split; auto; try (intros; eauto; fail).
    - intros k d H A; apply AC in A; destruct (I1 k d H A) as [l [q [E L]]]. exists l, q; split; [|exact L].
      destruct (cell_dec d c) as [->|D]; [congruence | now rewrite (Go d D)].
    - intros d l p E; apply AC; eauto.
    - intros m a b Ha Hb Aa Ab; eapply path_mono; [apply AC | intros ? ? ? Z; exact Z | apply le_n|].
      apply I9; auto; now apply AC.
    - intros a b Aa Ab; eapply Marking.way_same; [exact AC|]. apply I10; now apply AC.
    - intros d E e A; destruct (cell_dec d c) as [->|D]; [rewrite Gc in E; discriminate|]. rewrite (Go d D) in E.
      apply (I11 d E e); now apply AC.
  Qed.

  Lemma run_good : forall f used, run f used -> exists had got, good f used had got.
  Proof.
    intros f used R; induction R as [f S J | f used g used' R [had [got G]] A].
    { exists (fun _ _ => False), (fun _ _ _ => False). split; try contradiction; auto.
      all: intros c; intros; destruct (S c) as [E|[E|E]]; congruence. }
    destruct A as [f used c g F B | f used c p m q g F B P H | f used c l r p m q g F B P L H | f used c m g F N H
                  | f used c exit g A M Y X H | f used c m q g F M O H].
    - exists had, got; eapply is_entered; eauto.
    - do 2 eexists; eapply (opens _ _ _ _ c m (Some p) g); [exact G | unfold accessible; now rewrite F | auto | |
      exact H].
      split; [exact B | split; eauto].
    - do 2 eexists; eapply (opens _ _ _ _ c m (Some p) g);
        [exact G | unfold accessible; now rewrite F | right; eauto | | exact H]. split; [exact B | split; eauto].
    - do 2 eexists; eapply (opens _ _ _ _ c m None g); [exact G | unfold accessible; now rewrite F | auto | | exact H].
      split; [exact N | reflexivity].
    - exists had, got; eapply is_marked; eauto. intros ->; auto.
    - exists had, got; eapply is_marked; [exact G | unfold accessible; now rewrite F | exact M | right; eauto | |
      exact H].
      intros ->; right; eauto.
  Qed.

  Theorem trees_stay_connected : forall f used, run f used -> forall m a b p q, f a = Open m p -> f b = Open m q ->
    Marking.way cell beside (fun c => exists l r, f c = Open l r /\ m <= l) a b.
  Proof.
    intros f used R m a b p q Fa Fb; destruct (run_good f used R) as [had [got [I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11]]].
    assert (forall k c, had k c -> accessible f c -> m <= k -> exists l r, f c = Open l r /\ m <= l) as W.
    { intros k c H A L; destruct (I1 k c H A) as [l [r [F L']]]; exists l, r; split; [exact F | lia]. }
    assert (forall c, path f got m a c ->
      Marking.way cell beside (fun c => exists l r, f c = Open l r /\ m <= l) a c) as T.
    { intros c P; induction P as [A | b' c P IH [k [K E]] A]; [constructor; eauto|].
      pose proof (path_ends _ _ _ _ _ P) as B. eapply Marking.way_trans; [exact IH|].
      destruct E as [E|E]; destruct (I4 _ _ _ E); (eapply Marking.onward; [eauto | | constructor; eauto]);
        [eauto | apply beside_sym; eauto]. }
    apply T, I9; eauto; unfold accessible; [now rewrite Fa | now rewrite Fb].
  Qed.
End Trees.

(** The cells of a tree stay connected through cells of trees whose labels are not lower. *)
Theorem BRICKS_8 : forall (cell : Type) (beside : cell -> cell -> Prop),
  (forall a b : cell, a = b \/ a <> b) -> (forall a b, beside a b -> beside b a) -> (forall a b, beside a b ->
    a <> b) ->
  forall f used, run cell beside f used -> forall m a b p q, f a = Open cell m p -> f b = Open cell m q ->
  Marking.way cell beside (fun c => exists l r, f c = Open cell l r /\ m <= l) a b.
Proof. intros; eapply trees_stay_connected; eauto. Qed.

(** The accessible cells stay connected. *)
Theorem BRICKS_2 : forall (cell : Type) (beside : cell -> cell -> Prop),
  (forall a b : cell, a = b \/ a <> b) -> (forall a b, beside a b -> beside b a) -> (forall a b, beside a b ->
    a <> b) ->
  forall f used, run cell beside f used -> Marking.connected cell beside (accessible cell f).
Proof.
  intros cell beside D S O f used R; destruct (run_good cell beside D S O f used R) as [had [got G]].
  exact (left_connected _ _ _ _ _ _ G).
Qed.

(** An agent is done in a cell that it has marked and that stores no way on, and then every cell is visited. *)
Theorem BRICKS_4 : forall (cell : Type) (beside : cell -> cell -> Prop),
  (forall a b : cell, a = b \/ a <> b) -> (forall a b, beside a b -> beside b a) -> (forall a b, beside a b ->
    a <> b) ->
  forall f used, run cell beside f used -> forall c, f c = Visited cell None ->
  forall d, f d = Wall cell \/ exists exit, f d = Visited cell exit.
Proof.
  intros cell beside D S O f used R c E d; destruct (run_good cell beside D S O f used R) as [had [got G]].
  pose proof (none_left _ _ _ _ _ _ G c E d) as N. unfold accessible in N. destruct (f d); eauto; destruct (N I).
Qed.

(** Labels never fall from a cell of a tree to its parent, which is there as long as its child is. *)
Theorem BRICKS_9 : forall (cell : Type) (beside : cell -> cell -> Prop),
  (forall a b : cell, a = b \/ a <> b) -> (forall a b, beside a b -> beside b a) -> (forall a b, beside a b ->
    a <> b) ->
  forall f used, run cell beside f used -> forall c l p, f c = Open cell l (Some p) ->
  beside c p /\ exists m q, f p = Open cell m q /\ l <= m.
Proof.
  intros cell beside D S O f used R c l p E; destruct (run_good cell beside D S O f used R) as [had [got G]].
  pose proof (parent_got _ _ _ _ _ _ G c l p E) as X. split; [exact (got_beside _ _ _ _ _ _ G _ _ _ X)|].
  apply (had_open _ _ _ _ _ _ G l p); [apply (got_had _ _ _ _ _ _ G _ _ _ X) |
    exact (parent_left _ _ _ _ _ _ G c l p E)].
Qed.

(** What is needed: in a row of three cells the middle one is the parent of the others. If it were marked though it has
    children, the others would not be connected. *)
Definition in_a_row (a b : nat) : Prop := (b = S a \/ a = S b) /\ a < 3 /\ b < 3.
Definition put (f : floor nat) (c : nat) (n : note nat) : floor nat := fun d => if d =? c then n else f d.

Lemma put_becomes : forall f c n, becomes nat f c n (put f c n).
Proof.
  intros f c n; split; unfold put; [now rewrite Nat.eqb_refl|]. intros d D; now rewrite (proj2 (Nat.eqb_neq d c) D).
Qed.

Theorem without_Childless_breaks_BRICKS_2 : exists f used g, run nat in_a_row f used /\ f 1 = Open nat 0 None
  /\ (forall d, in_a_row 1 d -> f d = Open nat 0 (Some 1)) /\ becomes nat f 1 (Visited nat None) g
  /\ ~ Marking.connected nat in_a_row (accessible nat g).
Proof.
  set (f0 := fun c => match c with 1 => Explored nat | 0 | 2 => Unexplored nat | _ => Wall nat end).
  set (f1 := put (put (put f0 0 (Explored nat)) 2 (Explored nat)) 1 (Open nat 0 None)).
  set (f := put (put f1 0 (Open nat 0 (Some 1))) 2 (Open nat 0 (Some 1))).
  exists f, [0], (put f 1 (Visited nat None)). split; [|split; [reflexivity|split; [|split; [apply put_becomes|]]]].
  - assert (run nat in_a_row f0 []) as R.
    { apply starts; [intros [|[|[|c]]]; cbn; auto|]. intros a b A B.
      assert (a < 3 /\ b < 3) as [La Lb]
        by (destruct a as [|[|[|a]]], b as [|[|[|b]]]; cbn in A, B; lia || contradiction).
      assert (forall c, c < 3 -> Marking.way nat in_a_row (accessible nat f0) c 1
        /\ Marking.way nat in_a_row (accessible nat f0) 1 c) as W.
      { intros [|[|[|c]]] L; try lia; split; try (constructor; exact I).
        all: eapply Marking.onward; [exact I | | constructor; exact I]; unfold in_a_row; lia. }
      eapply Marking.way_trans; [apply W, La | apply W, Lb]. }
    eapply goes_on in R; [|apply enters with (c := 0); [reflexivity | apply put_becomes]].
    eapply goes_on in R; [|apply enters with (c := 2); [reflexivity | apply put_becomes]].
    eapply goes_on in R; [|apply founds with (c := 1) (m := 0); [reflexivity | intros [] | apply put_becomes]].
    eapply goes_on in R; [|apply joins with (c := 0) (p := 1) (m := 0) (q := None);
      [reflexivity | unfold in_a_row; lia | reflexivity | apply put_becomes]].
    eapply goes_on in R; [exact R|]. apply joins with (c := 2) (p := 1) (m := 0) (q := None);
      [reflexivity | unfold in_a_row; lia | reflexivity | apply put_becomes].
  - intros d [[->|E] [_ L]]; [reflexivity|]. assert (d = 0) as -> by lia. reflexivity.
  - intros C; specialize (C 0 2 I I). inversion C as [|? b ? _ B W]; subst. destruct B as [[B|B] _]; [subst b | lia].
    assert (accessible nat (put f 1 (Visited nat None)) 1) as A by (clear - W; inversion W; assumption). exact A.
Qed.
