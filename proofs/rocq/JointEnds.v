(** KIT-6, KIT-7 and KIT-8 of the drives of two robots, for every lattice, every set of walls and every order of what they do:
    while a joint way is left, a robot drives or may drive; they drive finitely often; and a robot that knows of no way
    is right. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Kit Sides Joint.
Import ListNotations.
Local Open Scope nat_scope.

(** Ways depend on moves and goals alone. *)
Lemma way_ext : forall A (f g : A -> list A) (p q : A -> bool), (forall a, f a = g a) -> (forall a, p a = q a) ->
  forall n a, way A f p n a <-> way A g q n a.
Proof.
  intros A f g p q F P n; induction n as [|n IH]; intros a; cbn [way]; [now rewrite P|]. rewrite F.
  split; intros [b [M W]]; exists b; split; auto; now apply IH.
Qed.
Lemma nearest_ext : forall A (f g : A -> list A) (p q : A -> bool), (forall a, f a = g a) -> (forall a, p a = q a) ->
  forall a n, nearest A f p a n <-> nearest A g q a n.
Proof.
  intros A f g p q F P a n; unfold nearest. rewrite (way_ext A f g p q F P n a).
  split; intros [W M]; split; auto; intros m L V; apply (M m L); now apply (way_ext A f g p q F P).
Qed.
Lemma nearest_one : forall A f p (a : A) n m, nearest A f p a n -> nearest A f p a m -> n = m.
Proof.
  intros A f p a n m [W F] [V G]. destruct (Nat.lt_trichotomy n m) as [L|[E|L]]; [exfalso; now apply (G n) | exact E |].
  exfalso; now apply (F m).
Qed.

(** No way is longer than there are places. *)
Lemma nearest_bound : forall A (same : A -> A -> bool) (all : list A) (moves : A -> list A) (goal : A -> bool), (forall a b, same a b = true <-> a = b) ->
  (forall a b, In a all -> In b (moves a) -> In b all) -> forall a n, In a all -> nearest A moves goal a n -> n <= length all.
Proof.
  intros A same all moves goal S C a n I [W F].
  assert (level A same all moves goal (Datatypes.S (length all)) = level A same all moves goal (length all)) as E.
  { destruct (levels_stop A same all moves goal S C (length all)) as [E|L]; [exact E|exfalso].
    destruct (level_filter A same all moves goal (Datatypes.S (length all))) as [f F'].
    assert (forall l : list A, length (filter f l) <= length l) as G.
    { induction l as [|b l IH]; cbn; [lia|]. destruct (f b); cbn; lia. }
    specialize (G all); rewrite F' in L; lia. }
  assert (In a (level A same all moves goal (length all + n))) as J by (apply level_spec; auto; split; [exact I | exists n; split;
    [lia | exact W]]).
  rewrite (level_fixed A same all moves goal _ E n) in J. apply level_spec in J; auto. destruct J as [_ [m [L V]]].
  destruct (Nat.le_gt_cases n m); [lia | exfalso; now apply (F m)].
Qed.

(** There is a way, or there is none. *)
Lemma nearest_or_none : forall A (same : A -> A -> bool) (all : list A) (moves : A -> list A) (goal : A -> bool), (forall a b, same a b = true <-> a = b) ->
  (forall a b, In a all -> In b (moves a) -> In b all) -> forall a, In a all ->
  (exists n, nearest A moves goal a n) \/ forall n, ~ way A moves goal n a.
Proof.
  intros A same all moves goal S C a I; pose proof (closer_spec A same all moves goal S C a I) as X.
  destruct (closer A same all moves goal a); [left; destruct X as [n [X _]]; eauto | now right].
Qed.

Section Two.
  Variables (cells : list cell) (border wall : edge -> bool).
  Hypothesis inside : forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells.
  Notation two := (two cells border wall).
  Notation may := (may cells border).

  (** ** KIT-6 and KIT-8 *)
  Lemma goes_on_alone : forall l w, two l w -> (forall i, i < 2 -> exists c, stances w i = Stands c) ->
    forall n, joint_nearest border w (ends w) n -> exists i c s, i < 2 /\ stances w i = Stands c /\ may w i s = true.
  Proof.
    intros l w R St n [W F].
    assert (forall i, i < 2 -> exists c, stances w i = Stands c /\ of (ends w) i = c /\ drives_new w i = false) as At.
    { intros i L; destruct (St i L) as [c E]; exists c; split; [exact E|]; split.
      - destruct i as [|[|]]; [| |lia]; cbn [of ends fst snd]; now rewrite E.
      - unfold drives_new; rewrite E; apply andb_false_r. }
    assert (forall i c, i < 2 -> stances w i = Stands c -> Stands (of (ends w) (1 - i)) = stances w (1 - i)) as Other.
    { intros i c L E; destruct (At (1 - i) ltac:(lia)) as [d [Ed [Od _]]]. now rewrite Od, Ed. }
    destruct n as [|n].
    - cbn [way] in W; unfold joint_goal in W; apply existsb_exists in W; destruct W as [i [I W]].
      assert (i < 2) as L by (cbn in I; lia). apply existsb_exists in W; destruct W as [s [U A]].
      destruct (At i L) as [c [E [O _]]]. unfold uncovered_sides in U; apply filter_In in U; destruct U as [_ U].
      exists i, c, s; split; [exact L|]; split; [exact E|]. unfold lets_of in A; rewrite (Other i c L E), O in A.
      unfold Joint.may; rewrite E, A. rewrite O in U; rewrite U; reflexivity.
    - destruct W as [q [M W]]. unfold joint_moves in M; apply in_flat_map in M; destruct M as [i [I M]].
      assert (i < 2) as L by (cbn in I; lia). apply in_map_iff in M; destruct M as [s [<- M]]; apply filter_In in M.
      destruct M as [D A]; apply driven_sides_spec in D. destruct (At i L) as [c [E [O _]]].
      unfold lets_of in A; rewrite (Other i c L E), O in A; rewrite O in D, W.
      exists i, c, s; split; [exact L|]; split; [exact E|].
      apply (old_drives cells border wall inside l w i c s R L E D). split; [exact A|]. right; split.
      + intros [X _]. destruct (At (1 - i) ltac:(lia)) as [d [_ [_ Y]]]; congruence.
      + exists n; split; [split; [exists (moved (ends w) i (beyond c s)); split; [|exact W] | exact F]|].
        * unfold joint_moves; apply in_flat_map; exists i; split; [exact I|]; apply in_map_iff; exists s; rewrite O; split;
            [reflexivity|]. apply filter_In; split; [now apply driven_sides_spec|]. unfold lets_of; now rewrite (Other i c L E), O.
        * split; [exact W|]. intros m Lm V; apply (F (S m)); [lia|]. exists (moved (ends w) i (beyond c s)); split; [|exact V].
          unfold joint_moves; apply in_flat_map; exists i; split; [exact I|]; apply in_map_iff; exists s; rewrite O; split;
            [reflexivity|]. apply filter_In; split; [now apply driven_sides_spec|]. unfold lets_of; now rewrite (Other i c L E), O.
  Qed.
End Two.

(** While there is a joint way to an uncovered side, a robot drives, or may drive. *)
Theorem KIT_6_drives : forall cells border wall,
  (forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells) ->
  forall l w, two cells border wall l w -> (exists n, joint_nearest border w (ends w) n) ->
  exists i, i < 2 /\ ((exists c s, stances w i = Drives c s)
                      \/ exists c s, stances w i = Stands c /\ may cells border w i s = true).
Proof.
  intros cells border wall I l w R [n N].
  destruct (stances w 0) as [a|a s] eqn:E0; [|exists 0; split; [lia|]; left; eauto].
  destruct (stances w 1) as [b|b s] eqn:E1; [|exists 1; split; [lia|]; left; eauto].
  destruct (goes_on_alone cells border wall I l w R) with (n := n) as [i [c [s [L [E M]]]]]; [|exact N|].
  - intros [|[|i]] L; [eauto | eauto | lia].
  - exists i; split; [exact L|]; right; eauto.
Qed.

(** A robot that has no part while nobody drives a new path knows that no joint way is left. *)
Theorem KIT_8_knows : forall cells border wall,
  (forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells) ->
  forall l w, two cells border wall l w -> forall i c, i < 2 -> stances w i = Stands c -> drives_new w (1 - i) = false ->
  (part cells border w i c = None <-> forall n, ~ joint_nearest border w (ends w) n).
Proof.
  intros cells border wall I l w R i c L E D. unfold part; rewrite D; unfold joint_part.
  pose proof (closer_spec pair same_pair (joint_places cells) (joint_moves w) (joint_goal border w) same_pair_spec
    (joint_closed cells border wall I l w R) (ends w) (ends_are_places cells border wall I l w R)) as X.
  destruct (closer _ _ _ _ _ _) as [near|]; cbn [option_map].
  - split; [discriminate|]. intros N; destruct X as [n [X _]]; exfalso; now apply (N n).
  - split; [intros _ n [W _]; now apply (X n) | reflexivity].
Qed.

(** ** KIT-7 *)
Definition is_leaving (e : event) : bool := match e with Leaves _ _ _ => true | _ => false end.

Section Ends.
  Variables (cells : list cell) (border wall : edge -> bool).
  Hypothesis inside : forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells.
  Notation two := (two cells border wall).
  Notation may := (may cells border).
  Notation joint_nearest := (joint_nearest border).
  Notation own_nearest := (own_nearest border).

  (** The sides of which nothing is known, each as often as it stands here, and the robots that drive new paths. *)
  Definition paths : list edge := flat_map (fun c => map (edge_of c) all_sides) cells.
  Definition is_known (w : world) (e : edge) : bool :=
    in_records 2 (driven w) e || (border e || in_records 2 (blocked w) e).
  Definition unknown (w : world) : nat := length (filter (fun e => negb (is_known w e)) paths).
  Definition one (b : bool) : nat := if b then 1 else 0.
  Definition busy (w : world) : nat := one (drives_new w 0) + one (drives_new w 1).

  (** How far a robot that does not drive a new path is from an uncovered side. *)
  Definition joint_far (w : world) (d : nat) : Prop :=
    joint_nearest w (ends w) d \/ (forall n, ~ joint_nearest w (ends w) n) /\ d = 0.
  Definition own_far (w : world) (i d : nat) : Prop :=
    own_nearest w i (next (stances w i)) d \/ (forall n, ~ own_nearest w i (next (stances w i)) n) /\ joint_far w d.
  Definition is_far (w : world) (d : nat) : Prop :=
    forall i, i < 2 -> drives_new w i = false -> if drives_new w (1 - i) then own_far w i d else joint_far w d.
  Definition most : nat := length (joint_places cells) + length cells.
  Definition measure (w : world) (d : nat) : nat := (3 * unknown w + busy w) * S most + d.

  Lemma far_some : forall l w, two l w -> exists d, is_far w d /\ d <= most.
  Proof.
    intros l w R; pose proof (ends_are_places cells border wall inside l w R) as Ip.
    assert (exists d, joint_far w d /\ d <= most) as [j [J Lj]].
    { destruct (nearest_or_none pair same_pair (joint_places cells) (joint_moves w) (joint_goal border w) same_pair_spec
        (joint_closed cells border wall inside l w R) (ends w) Ip) as [[n N]|N].
      - exists n; split; [now left|]. unfold most.
        pose proof (nearest_bound pair same_pair (joint_places cells) _ _ same_pair_spec
          (joint_closed cells border wall inside l w R) (ends w) n Ip N); lia.
      - exists 0; split; [right; split; [intros n [W _]; now apply (N n) | reflexivity] | lia]. }
    assert (forall i, i < 2 -> exists d, own_far w i d /\ d <= most) as Own.
    { intros i L. pose proof (proj2 (two_inside cells border wall inside l w R i L)) as Ic.
      destruct (nearest_or_none cell cell_eqb cells (own_moves w (stances w (1 - i))) (own_goal border w (stances w (1 - i)))
        cell_eqb_spec (own_closed cells border wall inside l w R _) _ Ic) as [[n N]|N].
      - exists n; split; [now left|]. unfold most.
        pose proof (nearest_bound cell cell_eqb cells _ _ cell_eqb_spec (own_closed cells border wall inside l w R _) _ n Ic N); lia.
      - exists j; split; [right; split; [intros n [W _]; now apply (N n) | exact J] | exact Lj]. }
    destruct (drives_new w 0) eqn:D0, (drives_new w 1) eqn:D1.
    - exists 0; split; [|lia]. intros [|[|i]] L E; [congruence | congruence | lia].
    - destruct (Own 1 ltac:(lia)) as [d [F Ld]]; exists d; split; [|exact Ld].
      intros [|[|i]] L E; [congruence | cbn [Nat.sub]; now rewrite D0 | lia].
    - destruct (Own 0 ltac:(lia)) as [d [F Ld]]; exists d; split; [|exact Ld].
      intros [|[|i]] L E; [cbn [Nat.sub]; now rewrite D1 | congruence | lia].
    - exists j; split; [|exact Lj]. intros [|[|i]] L E; cbn [Nat.sub]; [now rewrite D1 | now rewrite D0 | lia].
  Qed.

  (** Worlds with the same known sides have the same ways. *)
  Definition same_maps (w w' : world) : Prop :=
    forall c s, is_driven 2 w' c s = is_driven 2 w c s /\ is_blocked 2 border w' c s = is_blocked 2 border w c s.
  Lemma same_sides : forall w w', same_maps w w' -> forall c,
    driven_sides w' c = driven_sides w c /\ uncovered_sides border w' c = uncovered_sides border w c.
  Proof.
    intros w w' S c; split; unfold driven_sides, uncovered_sides; apply filter_ext; intros s; destruct (S c s) as [A B].
    - exact A.
    - unfold uncovered; now rewrite A, B.
  Qed.
  Lemma same_joint : forall w w', same_maps w w' -> forall p n, joint_nearest w' p n <-> joint_nearest w p n.
  Proof.
    intros w w' S p n; apply nearest_ext; intros q.
    - unfold joint_moves; apply flat_map_ext; intros i. now rewrite (proj1 (same_sides w w' S _)).
    - unfold joint_goal; cbn [existsb]. now rewrite !(proj2 (same_sides w w' S _)).
  Qed.
  Lemma same_own : forall w w' i, same_maps w w' -> stances w' (1 - i) = stances w (1 - i) ->
    forall c n, own_nearest w' i c n <-> own_nearest w i c n.
  Proof.
    intros w w' i S E c n; unfold Joint.own_nearest; rewrite E; apply nearest_ext; intros d.
    - unfold own_moves; now rewrite (proj1 (same_sides w w' S _)).
    - unfold own_goal; now rewrite (proj2 (same_sides w w' S _)).
  Qed.

  Lemma known_less : forall w w', (forall e, is_known w e = true -> is_known w' e = true) -> unknown w' <= unknown w.
  Proof.
    intros w w' K; unfold unknown; induction paths as [|e l IH]; cbn; [lia|]. specialize (K e).
    destruct (is_known w e); [rewrite K by reflexivity; exact IH|]. destruct (is_known w' e); cbn; lia.
  Qed.
  Lemma known_more : forall w w' e, (forall e, is_known w e = true -> is_known w' e = true) -> In e paths ->
    is_known w e = false -> is_known w' e = true -> unknown w' < unknown w.
  Proof.
    intros w w' e K I N Y; unfold unknown. assert (forall l, In e l -> length (filter (fun e => negb (is_known w' e)) l)
      < length (filter (fun e => negb (is_known w e)) l)) as G; [|now apply G].
    assert (forall l, length (filter (fun e => negb (is_known w' e)) l) <= length (filter (fun e => negb (is_known w e)) l)) as Le.
    { induction l as [|f l IH]; cbn; [lia|]. specialize (K f). destruct (is_known w f); [rewrite K by reflexivity; exact IH|].
      destruct (is_known w' f); cbn; lia. }
    induction l as [|f l IH]; intros J; [destruct J|]. cbn. destruct J as [->|J]; [rewrite N, Y; cbn; specialize (Le l); lia|].
    specialize (IH J); specialize (K f). destruct (is_known w f); [rewrite K by reflexivity; exact IH|].
    destruct (is_known w' f); cbn; lia.
  Qed.

  Lemma in_paths : forall c s, In c cells -> In (edge_of c s) paths.
  Proof. intros c s I; unfold paths; apply in_flat_map; exists c; split; [exact I | apply in_map; destruct s; cbn; auto]. Qed.

  Lemma in_records_with : forall f i e x, i < 2 -> in_records 2 (with_ f i (e :: f i)) x = in_records 2 f x || edge_eqb x e.
  Proof.
    intros f i e x L; apply eq_true_iff_eq; rewrite orb_true_iff, !in_records_spec, edge_eqb_spec. split.
    - intros [j [J I]]; apply in_with in I; destruct I as [I|[_ ->]]; [left; eauto | now right].
    - intros [[j [J I]]| ->]; [exists j; split; [exact J | apply in_with; now left] | exists i; split; [exact L |
        apply in_with; now right]].
  Qed.

  (** Something more is known: how far robots are then does not matter. *)
  Lemma less_unknown : forall l w w' d x, two l w' -> unknown w' < unknown w -> busy w' <= S (busy w) -> x <= 1 ->
    exists d', is_far w' d' /\ d' <= most /\ x + measure w' d' <= measure w d.
  Proof.
    intros l w w' d x R U B X; destruct (far_some l w' R) as [d' [F L]]; exists d'; split; [exact F|]; split; [exact L|].
    unfold measure. assert ((3 * unknown w' + busy w') + 2 <= 3 * unknown w + busy w) as H by lia.
    apply (Nat.mul_le_mono_r _ _ (S most)) in H. rewrite Nat.mul_add_distr_r in H. lia.
  Qed.

  Lemma one_step : forall l w e w' d, two l w -> is_far w d -> d <= most -> act 2 MARKED wall may w e = Some w' ->
    exists d', is_far w' d' /\ d' <= most /\ one (is_leaving e) + measure w' d' <= measure w d.
  Proof.
    intros l w e w' d R F Ld A. pose proof (run_goes_on _ _ _ _ _ _ _ _ _ R A) as R'.
    destruct e as [i c s|i c s|i c s|i]; cbn [act] in A; cbn [is_leaving one].
    - destruct (is_at 2 w i c) eqn:At; [|discriminate]. destruct (wall (edge_of c s)) eqn:W; [discriminate|].
      destruct (may w i s) eqn:M; [|discriminate]. cbn [andb negb] in A. injection A as <-.
      unfold is_at in At; apply andb_true_iff in At; destruct At as [L At]; apply Nat.ltb_lt in L.
      destruct (stances w i) as [c'|] eqn:E; [|discriminate]. apply cell_eqb_spec in At; subst c'.
      set (w' := {| stances := put (stances w) i (Drives c s) |}) in *.
      assert (drives_new w i = false) as Ni by (unfold drives_new; rewrite E; apply andb_false_r).
      assert (1 - i <> i) as Oi by lia.
      assert (drives_new w' (1 - i) = drives_new w (1 - i)) as No.
      { unfold drives_new; cbn [fresh stances w']; unfold with_; rewrite (Kit.put_other _ _ _ _ Oi).
        apply Nat.eqb_neq in Oi; now rewrite Oi. }
      assert (In c cells) as Ic by (pose proof (two_inside cells border wall inside l w R i L) as X; rewrite E in X; cbn in X; tauto).
      destruct (is_driven 2 w c s) eqn:Dr.
      + (* an old path *)
        assert (drives_new w' i = false) as Ni'.
        { unfold drives_new; cbn [fresh w']; unfold with_; rewrite Nat.eqb_refl; reflexivity. }
        assert (same_maps w w') as Sm.
        { intros a t; split; [|reflexivity]. unfold is_driven in *; cbn [driven w']; rewrite in_records_with by exact L.
          destruct (edge_eqb (edge_of a t) (edge_of c s)) eqn:X; [|apply orb_false_r]. apply edge_eqb_spec in X.
          rewrite X, Dr; reflexivity. }
        assert (ends w' = moved (ends w) i (beyond c s)) as En.
        { unfold ends; cbn [stances w']. destruct i as [|[|i]]; [reflexivity | reflexivity | lia]. }
        assert (next (stances w' i) = beyond c s) as Nx by (cbn [stances w']; now rewrite Kit.put_same).
        assert (stances w' (1 - i) = stances w (1 - i)) as So by (cbn [stances w']; now rewrite Kit.put_other).
        assert (unknown w' = unknown w /\ busy w' = busy w) as [U B].
        { split.
          - unfold unknown; f_equal; apply filter_ext; intros x; unfold is_known; cbn [driven blocked w'];
              rewrite in_records_with by exact L. destruct (edge_eqb x (edge_of c s)) eqn:X; [|now rewrite orb_false_r].
            apply edge_eqb_spec in X; unfold is_driven in Dr; now rewrite X, Dr.
          - unfold busy; destruct i as [|[|i]]; [| |lia]; cbn [Nat.sub] in No; now rewrite Ni, Ni', No. }
        apply (old_drives cells border wall inside l w i c s R L E Dr) in M; destruct M as [Le M].
        assert (forall n, (if drives_new w (1 - i) then own_far w' i n else joint_far w' n) -> is_far w' n) as Far.
        { intros n H k Lk Nk. destruct (Nat.eq_dec k i) as [->|Dk]; [now rewrite No|].
          assert (k = 1 - i) as -> by lia. rewrite No in Nk; rewrite Nk in H. replace (1 - (1 - i)) with i by lia. now rewrite Ni'. }
        specialize (F i L Ni). unfold measure; rewrite U, B.
        destruct M as [[[Gn [m Gm]] [n [N1 N2]]]|[Ga [n [N1 N2]]]].
        * rewrite Gn in F, Far. destruct F as [F|[F _]]; [|exfalso; rewrite E in F; now apply (F m)].
          rewrite E in F; cbn [next] in F. pose proof (nearest_one _ _ _ _ _ _ F N1) as ->.
          exists n; split; [|split; lia]. apply Far; left. rewrite Nx; now apply (same_own w w' i Sm So).
        * assert (joint_far w (S n)) as Jf by now left.
          assert (joint_far w' n) as Jf' by (left; rewrite En; now apply (same_joint w w' Sm)).
          assert (joint_far w d) as Fd.
          { destruct (drives_new w (1 - i)) eqn:Gn; [|exact F]. destruct F as [F|[_ F]]; [|exact F].
            exfalso; apply Ga; split; [exact Gn|]. rewrite E in F; eauto. }
          destruct Fd as [Fd|[Fd _]]; [|exfalso; now apply (Fd (S n))]. pose proof (nearest_one _ _ _ _ _ _ Fd N1) as ->.
          exists n; split; [|split; lia]. apply Far. destruct (drives_new w (1 - i)) eqn:Gn; [|exact Jf'].
          right; split; [|exact Jf']. intros k H; rewrite Nx in H; apply (same_own w w' i Sm So) in H. apply Ga; split; [exact Gn|].
          destruct (nearest_or_none cell cell_eqb cells (own_moves w (stances w (1 - i))) (own_goal border w (stances w (1 - i)))
            cell_eqb_spec (own_closed cells border wall inside l w R _) c Ic) as [X|X]; [exact X|].
          exfalso; apply (X (S k)); exists (beyond c s); split; [|exact (proj1 H)].
          unfold own_moves; apply in_map, filter_In; split; [now apply driven_sides_spec | exact Le].
      + (* a new one *)
        eapply less_unknown; [exact R' | | | lia].
        * apply known_more with (e := edge_of c s); [|now apply in_paths| |].
          -- intros x; unfold is_known; cbn [driven blocked w']; rewrite in_records_with by exact L.
             destruct (in_records 2 (driven w) x); [reflexivity|]. intros H; cbn [orb] in H |- *; rewrite H; apply orb_true_r.
          -- unfold Joint.may in M; rewrite E in M. unfold is_known. unfold is_driven in Dr; rewrite Dr. cbn [orb].
             destruct (lets c (stances w (1 - i)) s); [|discriminate].
             assert (is_blocked 2 border w c s = false) as Bl; [|exact Bl].
             destruct (is_blocked 2 border w c s) eqn:Bl; [exfalso|reflexivity].
             replace (uncovered 2 border w c s) with false in M by (unfold uncovered; rewrite Bl; symmetry; apply andb_false_r).
             destruct (part cells border w i c) as [p|] eqn:P; [|discriminate].
             assert (exists q, In s q /\ incl q (driven_sides w c)) as [q [Iq Sq]].
             { exists p; split.
               - cbn in M. apply existsb_exists in M; destruct M as [t [I H]]. assert (s = t) as -> by (destruct s, t; (discriminate ||
                   reflexivity)). exact I.
               - unfold part, own_part, joint_part in P. destruct (drives_new w (1 - i)).
                 + destruct (closer cell _ _ _ _ _); cbn [option_map] in P.
                   * injection P as <-; intros t I; now apply filter_In in I.
                   * destruct (closer pair _ _ _ _ _); [|discriminate]. injection P as <-; intros t I; now apply filter_In in I.
                 + destruct (closer pair _ _ _ _ _); [|discriminate]. injection P as <-; intros t I; now apply filter_In in I. }
             apply Sq, driven_sides_spec in Iq; unfold is_driven in Iq; congruence.
          -- unfold is_known; cbn [driven w']; rewrite in_records_with by exact L.
             assert (edge_eqb (edge_of c s) (edge_of c s) = true) as -> by now apply edge_eqb_spec. now rewrite orb_true_r.
        * unfold busy; destruct i as [|[|i]]; [| |lia]; cbn [Nat.sub] in No; rewrite Ni, No;
            destruct (drives_new w' 0), (drives_new w' 1), (drives_new w 0), (drives_new w 1); cbn; lia.
    - destruct (is_at 2 w i c) eqn:At; [|discriminate]. destruct (wall (edge_of c s)) eqn:W; [|discriminate]. injection A as <-.
      cbn [MARKED is_marked andb] in R' |- *. unfold is_at in At; apply andb_true_iff in At; destruct At as [L At]; apply Nat.ltb_lt in L.
      destruct (stances w i) as [c'|] eqn:E; [|discriminate]. apply cell_eqb_spec in At; subst c'.
      assert (In c cells) as Ic by (pose proof (two_inside cells border wall inside l w R i L) as X; rewrite E in X; cbn in X; tauto).
      set (w' := {| stances := stances w; driven := driven w |}) in *.
      assert (forall x, is_known w' x = is_known w x || edge_eqb x (edge_of c s)) as Kn.
      { intros x; unfold is_known; cbn [driven blocked w']; rewrite in_records_with by exact L. now rewrite !orb_assoc. }
      destruct (is_blocked 2 border w c s) eqn:Bl.
      + assert (same_maps w w') as Sm.
        { intros a t; split; [reflexivity|]. unfold is_blocked in *; cbn [blocked w']; rewrite in_records_with by exact L.
          destruct (edge_eqb (edge_of a t) (edge_of c s)) eqn:X; [|now rewrite orb_false_r]. apply edge_eqb_spec in X.
          rewrite X, orb_assoc, Bl; reflexivity. }
        exists d; split; [|split; [exact Ld|]].
        * intros k Lk Nk; specialize (F k Lk Nk). change (drives_new w' (1 - k)) with (drives_new w (1 - k)).
          destruct (drives_new w (1 - k)).
          -- destruct F as [F|[F G]]; [left; now apply (same_own w w' k Sm eq_refl) | right; split].
             ++ intros n H; apply (same_own w w' k Sm eq_refl) in H; now apply (F n).
             ++ destruct G as [G|[G ->]]; [left; now apply (same_joint w w' Sm) | right; split; [|reflexivity]].
                intros n H; apply (same_joint w w' Sm) in H; now apply (G n).
          -- destruct F as [G|[G ->]]; [left; now apply (same_joint w w' Sm) | right; split; [|reflexivity]].
             intros n H; apply (same_joint w w' Sm) in H; now apply (G n).
        * unfold measure; change (busy w') with (busy w). assert (unknown w' <= unknown w) as U by
            (apply known_less; intros x H; rewrite Kn, H; reflexivity).
          cbn [Nat.add]; apply Nat.add_le_mono_r, Nat.mul_le_mono_r; lia.
      + eapply less_unknown; [exact R' | | | lia].
        * apply known_more with (e := edge_of c s); [|now apply in_paths| |].
          -- intros x H; rewrite Kn, H; reflexivity.
          -- unfold is_known; unfold is_blocked in Bl; rewrite Bl. rewrite orb_false_r.
             destruct (in_records 2 (driven w) (edge_of c s)) eqn:X; [exfalso|reflexivity].
             apply in_records_spec in X; destruct X as [j [_ X]]. destruct (recorded _ _ _ _ _ _ _ R) as [H [_ [D _]]].
             apply H in X; destruct X as [a [t [X Y]]]. apply D in X; destruct X as [_ X]; congruence.
          -- rewrite Kn. assert (edge_eqb (edge_of c s) (edge_of c s) = true) as -> by now apply edge_eqb_spec. apply orb_true_r.
        * change (busy w') with (busy w); lia.
    - destruct (is_at 2 w i c && negb (wall (edge_of c s))); [|discriminate]. injection A as <-. exists d; auto.
    - destruct (stances w i) as [c|c s] eqn:E; [discriminate|]. destruct (Nat.ltb_spec i 2) as [L|]; [|discriminate].
      injection A as <-. set (w' := {| stances := put (stances w) i (Stands (beyond c s)) |}) in *.
      assert (1 - i <> i) as Oi by lia.
      assert (drives_new w' i = false) as Ni' by (unfold drives_new; cbn [stances w']; rewrite Kit.put_same; apply andb_false_r).
      assert (drives_new w' (1 - i) = drives_new w (1 - i)) as No.
      { unfold drives_new; cbn [fresh stances w']; now rewrite (Kit.put_other _ _ _ _ Oi). }
      destruct (drives_new w i) eqn:Ni.
      + destruct (far_some _ _ R') as [d' [F' L']]; exists d'; split; [exact F'|]; split; [exact L'|]. unfold measure.
        change (unknown w') with (unknown w).
        assert (S (busy w') = busy w) as B.
        { unfold busy; destruct i as [|[|i]]; [| |lia]; cbn [Nat.sub] in No; rewrite Ni, Ni', No; cbn; lia. }
        rewrite <- B, Nat.add_succ_r; cbn [Nat.mul]. lia.
      + assert (same_maps w w') as Sm by (intros a t; split; reflexivity).
        assert (ends w' = ends w) as En.
        { unfold ends; cbn [stances w']. destruct i as [|[|i]]; [| |lia]; unfold put; cbn; now rewrite E. }
        exists d; split; [|split; [exact Ld|]].
        * intros k Lk Nk. assert (drives_new w k = false) as Nw.
          { destruct (Nat.eq_dec k i) as [->|Dk]; [exact Ni|]. assert (k = 1 - i) as -> by lia. congruence. }
          specialize (F k Lk Nw). assert (drives_new w' (1 - k) = drives_new w (1 - k)) as Nk'.
          { destruct (Nat.eq_dec k i) as [->|Dk]; [exact No|]. assert (k = 1 - i) as -> by lia.
            replace (1 - (1 - i)) with i by lia; congruence. }
          assert (forall m, joint_far w m -> joint_far w' m) as J.
          { intros m [G|[G ->]]; [left; rewrite En; now apply (same_joint w w' Sm) | right; split; [|reflexivity]].
            intros n H; rewrite En in H; apply (same_joint w w' Sm) in H; now apply (G n). }
          rewrite Nk'. destruct (drives_new w (1 - k)) eqn:Gk; [|now apply J].
          assert (k = i) as -> by (destruct (Nat.eq_dec k i) as [|Dk]; [assumption|]; assert (k = 1 - i) as -> by lia;
            replace (1 - (1 - i)) with i in Gk by lia; congruence).
          assert (stances w' (1 - i) = stances w (1 - i)) as So by (cbn [stances w']; now rewrite Kit.put_other).
          assert (next (stances w' i) = next (stances w i)) as Nx by (cbn [stances w']; rewrite Kit.put_same, E; reflexivity).
          destruct F as [F|[F G]]; [left; rewrite Nx; now apply (same_own w w' i Sm So) | right; split; [|now apply J]].
          intros n H; rewrite Nx in H; apply (same_own w w' i Sm So) in H; now apply (F n).
        * unfold measure; change (unknown w') with (unknown w).
          assert (busy w' = busy w) as -> by (unfold busy; destruct i as [|[|i]]; [| |lia]; cbn [Nat.sub] in No;
            now rewrite Ni, Ni', No). cbn; lia.
  Qed.

  Lemma finitely_many : forall l w, two l w -> exists d, is_far w d /\ d <= most
    /\ length (filter is_leaving l) + measure w d <= (3 * length paths + 2) * S most + most.
  Proof.
    intros l w R; induction R as [t S|l w e w' R [d [F [L B]]] A].
    - assert (two [] (Sides.begins t)) as R by now apply run_begins. destruct (far_some _ _ R) as [d [F L]].
      exists d; split; [exact F|]; split; [exact L|]. cbn [filter length Nat.add]. unfold measure.
      assert (unknown (Sides.begins t) <= length paths) as U.
      { unfold unknown; generalize (fun e => negb (is_known (Sides.begins t) e)); intros f.
        induction paths as [|x k IH]; cbn; [lia|]. destruct (f x); cbn; lia. }
      assert (busy (Sides.begins t) <= 2) as Bu by (unfold busy; destruct (drives_new _ 0), (drives_new _ 1); cbn; lia).
      apply Nat.add_le_mono; [apply Nat.mul_le_mono_r; lia | exact L].
    - destruct (one_step l w e w' d R F L A) as [d' [F' [L' M]]]. exists d'; split; [exact F'|]; split; [exact L'|].
      cbn [filter]; destruct (is_leaving e); cbn [length one] in *; lia.
  Qed.
End Ends.

(** Two robots begin to drive at most so often, however long the run is. *)
Theorem KIT_7_drives : forall cells border wall,
  (forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells) ->
  exists bound, forall l w, two cells border wall l w -> length (filter is_leaving l) <= bound.
Proof.
  intros cells border wall I; exists ((3 * length (paths cells) + 2) * S (most cells) + most cells); intros l w R.
  destruct (finitely_many cells border wall I l w R) as [d [_ [_ B]]].
  eapply Nat.le_trans; [apply Nat.le_add_r | exact B].
Qed.
