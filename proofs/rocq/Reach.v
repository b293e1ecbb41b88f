(** CHAIN-13. The cells within reach of a chain: those at most N-1 links from the base. For every number of robots and
    every layout, the chain can be brought into each of them by team moves that the relation admits, unfolding
    (Unfolding.v); and a run that ends when no unexplored cell is within reach in the map known by then has explored all
    that is within reach in the layout. ChainEnds.v compares the ends of the kernel's runs. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Rings Unfolding.
Import ListNotations.

Section Reach.
  Variables (wall : edge -> bool) (base : cell).

  Definition turns (s : side) : list side :=
    match s with East | West => [South; North] | South | North => [East; West] end.
  Definition passable (c : cell) (s : side) : bool := negb (wall (edge_of c s)).

  (** The cells one link away: beyond a side without a wall, or round a corner by two of them. *)
  Definition links (c : cell) : list cell :=
    flat_map (fun s => if passable c s
      then beyond c s :: map (beyond (beyond c s)) (filter (passable (beyond c s)) (turns s)) else []) all_sides.

  (** The cells at most [n] links from the base. *)
  Definition is_in (l : list cell) (c : cell) : bool := existsb (cell_eqb c) l.
  Definition grow (l : list cell) (c : cell) : list cell := if is_in l c then l else c :: l.
  Fixpoint reached (n : nat) : list cell :=
    match n with O => [base] | S n => fold_left grow (flat_map links (reached n)) (reached n) end.

  Lemma is_in_spec : forall l c, is_in l c = true <-> In c l.
  Proof.
    intros l c; unfold is_in; rewrite existsb_exists; split; [intros [x [I E]]; apply cell_eqb_spec in E; now subst|].
    intros I; exists c; split; [exact I | now apply cell_eqb_spec].
  Qed.

  Lemma grow_spec : forall more l c, In c (fold_left grow more l) <-> In c l \/ In c more.
  Proof.
    induction more as [|a more IH]; intros l c; cbn [fold_left]; [cbn; tauto|]. rewrite IH; unfold grow.
    destruct (is_in l a) eqn:E; cbn [In]; [apply is_in_spec in E | tauto].
    split; [tauto|]. intros [H|[<-|H]]; auto.
  Qed.

  Lemma reached_S : forall n c, In c (reached (S n)) <->
    In c (reached n) \/ exists a, In a (reached n) /\ In c (links a).
  Proof. intros n c; cbn [reached]; rewrite grow_spec, in_flat_map; reflexivity. Qed.

  Lemma links_spec : forall a c, In c (links a) -> exists s, passable a s = true
    /\ (c = beyond a s \/ exists t, In t (turns s) /\ passable (beyond a s) t = true /\ c = beyond (beyond a s) t).
  Proof.
    intros a c I; apply in_flat_map in I; destruct I as [s [_ I]]. destruct (passable a s) eqn:P; [|destruct I].
    exists s; split; [exact P|]. destruct I as [<-|I]; [auto|]. apply in_map_iff in I; destruct I as [t [<- I]].
    apply filter_In in I; right; exists t; tauto.
  Qed.

  Lemma beside_is_linked : forall a s, passable a s = true -> In (beyond a s) (links a).
  Proof.
    intros a s P; apply in_flat_map; exists s; split; [destruct s; cbn; auto|]. rewrite P; now left.
  Qed.

  (** A walk to a cell [n] links away and no fewer: its cells, how many steps, and which of them are stops. *)
  Record is_way (n : nat) (c : cell) (walk : nat -> cell) (length : nat) (stop : nat -> nat) : Prop := {
    way_begins : walk 0 = base;
    way_ends : walk length = c;
    way_steps : forall k, k < length -> exists s, walk (S k) = beyond (walk k) s /\ passable (walk k) s = true;
    way_once : forall j k, j <= length -> k <= length -> walk j = walk k -> j = k;
    way_near : forall k, k <= length -> In (walk k) (reached n);
    way_stop : stop 0 = 0;
    way_last : stop n = length;
    way_links : forall i, i < n -> stop (S i) = S (stop i) \/ (stop (S i) = stop i + 2
      /\ (apart_x (walk (stop i)) (walk (stop i + 2)%nat) <= 1)%Z
      /\ (apart_y (walk (stop i)) (walk (stop i + 2)%nat) <= 1)%Z);
    way_stops : forall i, i <= n -> stop i <= length;
  }.

  Definition then_ {A : Type} (f : nat -> A) (k : nat) (a : A) : nat -> A := fun j => if j <=? k then f j else a.
  Lemma then_before : forall (A : Type) (f : nat -> A) k a j, j <= k -> then_ f k a j = f j.
  Proof. intros; unfold then_; destruct (Nat.leb_spec j k); [reflexivity | lia]. Qed.
  Lemma then_after : forall (A : Type) (f : nat -> A) k a j, k < j -> then_ f k a j = a.
  Proof. intros; unfold then_; destruct (Nat.leb_spec j k); [lia | reflexivity]. Qed.

  (** One cell more. *)
  Lemma once_more : forall (walk : nat -> cell) length n c,
    (forall j k, j <= length -> k <= length -> walk j = walk k -> j = k) ->
    (forall k, k <= length -> In (walk k) n) -> ~ In c n ->
    forall j k, j <= S length -> k <= S length -> then_ walk length c j = then_ walk length c k -> j = k.
  Proof.
    intros walk length n c O Z X j k J K E. unfold then_ in E.
    destruct (Nat.leb_spec j length), (Nat.leb_spec k length); [auto | | | lia]; exfalso; apply X.
    - rewrite <- E; now apply Z.
    - rewrite E; now apply Z.
  Qed.

  Lemma steps_more : forall (walk : nat -> cell) length s,
    (forall k, k < length -> exists s, walk (S k) = beyond (walk k) s /\ passable (walk k) s = true) -> passable (walk length) s = true ->
    forall k, k < S length -> exists t, then_ walk length (beyond (walk length) s) (S k)
      = beyond (then_ walk length (beyond (walk length) s) k) t
      /\ passable (then_ walk length (beyond (walk length) s) k) t = true.
  Proof.
    intros walk length s H P k K. rewrite (then_before _ walk length _ k) by lia.
    destruct (Nat.eq_dec k length) as [->|D]; [rewrite then_after by lia; eauto|].
    rewrite then_before by lia; apply H; lia.
  Qed.

  Lemma way_to : forall n c, In c (reached n) -> (forall m, m < n -> ~ In c (reached m)) ->
    exists walk length stop, is_way n c walk length stop.
  Proof.
    induction n as [|n IH]; intros c I F.
    { destruct I as [<-|[]]. exists (fun _ => base), 0, (fun _ => 0).
      split; auto; intros; try lia. now left. }
    specialize (F n ltac:(lia)) as Fn. apply reached_S in I; destruct I as [I|[a [A L]]]; [contradiction|].
    assert (forall x s, In x (reached n) -> c = beyond x s -> passable x s = true ->
      exists walk length stop, is_way (S n) c walk length stop) as SIDE.
    { intros x s X -> P. destruct (IH x X) as [walk [length [stop [W1 W2 W3 W4 W5 W6 W7 W8 W9]]]].
      { intros m M Y; apply (F (S m) ltac:(lia)), reached_S; right; exists x.
        split; [exact Y | now apply beside_is_linked]. }
      exists (then_ walk length (beyond x s)), (S length), (then_ stop n (S length)). subst x. split.
      - now rewrite then_before by lia.
      - now rewrite then_after by lia.
      - now apply steps_more.
      - eapply once_more; eauto.
      - intros k K; apply reached_S. destruct (Nat.eq_dec k (S length)) as [->|D].
        + rewrite then_after by lia; right; exists (walk length); split; [exact X | now apply beside_is_linked].
        + rewrite then_before by lia; left; apply W5; lia.
      - now rewrite then_before by lia.
      - now rewrite then_after by lia.
      - intros i J; rewrite (then_before _ stop n _ i) by lia. destruct (Nat.eq_dec i n) as [->|D].
        + rewrite then_after by lia; left; lia.
        + rewrite then_before by lia. pose proof (W9 i ltac:(lia)); pose proof (W9 (S i) ltac:(lia)).
          destruct (W8 i ltac:(lia)) as [E|[E Q]]; [auto|]. right; split; [exact E|].
          rewrite !then_before by lia; exact Q.
      - intros i J; destruct (Nat.eq_dec i (S n)) as [->|D]; [rewrite then_after; lia|].
        rewrite then_before by lia; specialize (W9 i ltac:(lia)); lia. }
    destruct (links_spec _ _ L) as [s [P [E|[t [T [Q E]]]]]]; [now apply (SIDE a s)|].
    destruct (is_in (reached n) (beyond a s)) eqn:M; [apply is_in_spec in M; now apply (SIDE (beyond a s) t)|].
    assert (~ In (beyond a s) (reached n)) as NM by (intros H; apply is_in_spec in H; congruence). clear M SIDE.
    destruct (IH a A) as [walk [length [stop [W1 W2 W3 W4 W5 W6 W7 W8 W9]]]].
    { intros m M Y; apply (F (S m) ltac:(lia)), reached_S; eauto. }
    set (w := then_ walk length (beyond a s)). set (v := then_ w (S length) c).
    assert (forall k, k <= length -> v k = walk k) as V by (intros; unfold v, w; now rewrite !then_before by lia).
    assert (v (S length) = beyond a s) as VM by (unfold v, w; rewrite then_before, then_after by lia; reflexivity).
    assert (v (S (S length)) = c) as VC by (unfold v; now rewrite then_after by lia).
    exists v, (S (S length)), (then_ stop n (S (S length))). split.
    - now rewrite V by lia.
    - exact VC.
    - assert (w (S length) = beyond a s) as WE by (unfold w; now rewrite then_after by lia).
      unfold v; rewrite E, <- WE; apply steps_more; [|now rewrite WE]. unfold w; subst a; now apply steps_more.
    - intros j k J K H.
      destruct (Nat.eq_dec j (S (S length))) as [->|DJ], (Nat.eq_dec k (S (S length))) as [->|DK]; auto.
      + exfalso. rewrite VC in H. destruct (Nat.eq_dec k (S length)) as [->|D].
        * rewrite VM in H. apply (after_cross (beyond a s) t); cbn [after]; congruence.
        * rewrite V in H by lia; apply Fn; rewrite H; apply W5; lia.
      + exfalso. rewrite VC in H. destruct (Nat.eq_dec j (S length)) as [->|D].
        * rewrite VM in H. apply (after_cross (beyond a s) t); cbn [after]; congruence.
        * rewrite V in H by lia; apply Fn; rewrite <- H; apply W5; lia.
      + unfold v in H; rewrite !then_before in H by lia.
        apply (once_more walk length (reached n) (beyond a s) W4 W5 NM j k); auto; lia.
    - intros k K; apply reached_S. destruct (Nat.eq_dec k (S (S length))) as [->|D]; [rewrite VC; right; eauto|].
      destruct (Nat.eq_dec k (S length)) as [->|D'].
      + rewrite VM; right; exists a; split; [exact A | now apply beside_is_linked].
      + rewrite V by lia; left; apply W5; lia.
    - now rewrite then_before by lia.
    - now rewrite then_after by lia.
    - intros i J; rewrite (then_before _ stop n _ i) by lia. destruct (Nat.eq_dec i n) as [->|D].
      + rewrite then_after by lia; right. rewrite W7, (V length) by lia.
        replace (length + 2) with (S (S length)) by lia. rewrite VC, W2, E. split; [reflexivity|].
        destruct a as [x y], s; cbn in T; destruct T as [<-|[<-|[]]]; unfold apart_x, apart_y; cbn; lia.
      + rewrite then_before by lia. pose proof (W9 i ltac:(lia)); pose proof (W9 (S i) ltac:(lia)).
        destruct (W8 i ltac:(lia)) as [E'|[E' R]]; [auto|]. right; split; [exact E'|]. rewrite !V by lia; exact R.
    - intros i J; destruct (Nat.eq_dec i (S n)) as [->|D]; [rewrite then_after; lia|].
      rewrite then_before by lia; specialize (W9 i ltac:(lia)); lia.
  Qed.
End Reach.

(** The step from a cell to one beside it, or to itself. *)
Definition towards (c d : cell) : step :=
  match find (fun s => cell_eqb (beyond c s) d) all_sides with Some s => Cross s | None => Stay end.

Lemma towards_beyond : forall c s, towards c (beyond c s) = Cross s.
Proof.
  intros [x y] s; unfold towards, beyond, cell_eqb; destruct s; cbn [all_sides find fst snd offset].
  all: repeat match goal with |- context [(?a =? ?b)%Z] => destruct (Z.eqb_spec a b) end; cbn; auto; lia.
Qed.
Lemma towards_itself : forall c, towards c c = Stay.
Proof.
  intros [x y]; unfold towards, beyond, cell_eqb; cbn [all_sides find fst snd offset].
  all: repeat match goal with |- context [(?a =? ?b)%Z] => destruct (Z.eqb_spec a b) end; cbn; auto; lia.
Qed.

(** Unfolding the chain along a way: the leader comes to its end. *)
Section Unfolds.
  Variables (N : nat) (base : cell) (wall : edge -> bool) (n : nat) (c : cell) (walk : nat -> cell) (length : nat)
    (stop : nat -> nat).
  Hypothesis two_robots : 2 <= N.
  Hypothesis enough : n <= N - 1.
  Hypothesis way : is_way wall base n c walk length stop.

  (** Where each robot stops: the leader at the end, the others one link apart, whoever is not needed in the base. *)
  Definition stops_at (i : nat) : nat := stop (i - (N - 1 - n)).
  Fixpoint places_after (k : nat) : nat -> nat :=
    match k with O => fun _ => 0 | S k => planned_place N stops_at (places_after k) end.
  Definition plan_after (k : nat) : plan := fun i => towards (walk (places_after k i)) (walk (places_after (S k) i)).

  Lemma a_walk : is_walk base walk length.
  Proof.
    destruct way; split; auto. intros k K; destruct (way_steps0 k K) as [s [E _]]; eauto.
  Qed.

  Lemma the_stops : are_stops N walk length stops_at.
  Proof.
    destruct way; unfold stops_at; split.
    - replace (0 - (N - 1 - n)) with 0 by lia; assumption.
    - replace (pred N - (N - 1 - n)) with n by lia; lia.
    - intros i L. destruct (Nat.leb_spec (S i) (N - 1 - n)).
      + replace (S i - (N - 1 - n)) with 0 by lia; replace (i - (N - 1 - n)) with 0 by lia; left; lia.
      + replace (S i - (N - 1 - n)) with (S (i - (N - 1 - n))) by lia.
        destruct (way_links0 (i - (N - 1 - n)) ltac:(lia)) as [E|E]; [left; lia | right; exact E].
  Qed.

  Lemma on_it : forall k, on_the_walk N stops_at (places_after k).
  Proof.
    destruct (CHAIN_13_step N base walk length stops_at two_robots a_walk the_stops) as [Z K].
    induction k as [|k IH]; [exact Z | now apply K].
  Qed.

  Lemma one_farther : forall k i, i < N -> places_after (S k) i <= length
    /\ (places_after (S k) i = places_after k i \/ places_after (S k) i = S (places_after k i)).
  Proof.
    intros k i L. cbn [places_after].
    assert (stops_at 0 = 0) as Z by apply the_stops.
    assert (stops_at (pred N) <= length) as E by apply the_stops.
    pose proof (planned_bounds N two_robots length stops_at Z E (places_after k) i L (on_it k)).
    pose proof (last_length N two_robots walk length stops_at Z E (stops_link _ _ _ _ the_stops) i L). lia.
  Qed.

  Lemma leader_goes : forall k, k <= length -> places_after k (pred N) = k.
  Proof.
    assert (stops_at (pred N) = length) as E
      by (unfold stops_at; replace (pred N - (N - 1 - n)) with n by lia; exact (way_last _ _ _ _ _ _ _ way)).
    induction k as [|k IH]; intros L; [reflexivity|]. cbn [places_after].
    rewrite planned_leader, E, IH by lia. destruct (Nat.ltb_spec k length); lia.
  Qed.

  Lemma plan_leads : forall k i, i < N ->
    after (walk (places_after k i)) (plan_after k i) = walk (places_after (S k) i)
    /\ arrives wall (walk (places_after k i)) (plan_after k i) = true.
  Proof.
    intros k i L; unfold plan_after; destruct (one_farther k i L) as [B [E|E]]; rewrite E.
    - rewrite towards_itself; auto.
    - destruct (way_steps _ _ _ _ _ _ _ way (places_after k i) ltac:(lia)) as [s [W P]]; rewrite W, towards_beyond.
      split; [reflexivity | exact P].
  Qed.

  Lemma unfolds : forall k, exists past st, run N REPAIRED base wall past st
    /\ forall i, i < N -> pos st i = walk (places_after k i).
  Proof.
    destruct (CHAIN_13_step N base walk length stops_at two_robots a_walk the_stops) as [_ K].
    induction k as [|k [past [st [R P]]]].
    - do 2 eexists; split; [apply run_start; split; [|split]; [intros i _; reflexivity | reflexivity | constructor]|].
      intros i _; cbn; symmetry; apply way.
    - exists (pos (advance N wall st (plan_after k)) :: past), (advance N wall st (plan_after k)). split.
      + eapply run_advance; [exact R | |split; [|split]]; try (intros i _; reflexivity); try reflexivity.
        * apply (proj2 (K _ (on_it k))).
          -- intros i L; rewrite P by exact L; split; [reflexivity | now apply plan_leads].
          -- rewrite P by lia. destruct (on_it k) as [Z _]; rewrite Z; apply way.
        * cbn; constructor; [intros i _; reflexivity|]. generalize (log st) as l.
          induction l; constructor; auto; intros i _; reflexivity.
      + intros i L; cbn; unfold moved, made. rewrite P by exact L. destruct (plan_leads k i L) as [A ->]; exact A.
  Qed.
End Unfolds.

(** At most [n] links are [m] links and no fewer, [m <= n]. *)
Lemma fewest_links : forall wall base n c, In c (reached wall base n) ->
  exists m, m <= n /\ In c (reached wall base m) /\ forall k, k < m -> ~ In c (reached wall base k).
Proof.
  intros wall base n; induction n as [|n IH]; intros c I; [exists 0; repeat split; auto; intros; lia|].
  destruct (is_in (reached wall base n) c) eqn:E.
  - apply is_in_spec in E; destruct (IH c E) as [m [L H]]; exists m; split; [lia | exact H].
  - exists (S n); repeat split; auto. intros k K Y.
    assert (In c (reached wall base n)); [|apply is_in_spec in H; congruence].
    clear - K Y. induction n as [|n IH]; [replace 0 with k by lia; exact Y|].
    destruct (Nat.eq_dec k (S n)) as [->|D]; [exact Y|]. apply reached_S; left; apply IH; lia.
Qed.

(** A chain that knows the layout can be brought into each cell within reach. *)
Theorem within_reach_is_reachable : forall N base wall c, 2 <= N -> In c (reached wall base (N - 1)) ->
  exists past st, run N REPAIRED base wall past st /\ pos st (pred N) = c.
Proof.
  intros N base wall c L I; destruct (fewest_links wall base _ c I) as [m [M [J F]]].
  destruct (way_to wall base m c J F) as [walk [length [stop W]]].
  destruct (unfolds N base wall m c walk length stop L M W length) as [past [st [R P]]].
  exists past, st; split; [exact R|]. rewrite P by lia.
  rewrite (leader_goes N base wall m c walk length stop L M W length) by lia. apply W.
Qed.

(** Fewer walls, more within reach. *)
Lemma reached_mono : forall wall met base, (forall e, met e = true -> wall e = true) ->
  forall n c, In c (reached wall base n) -> In c (reached met base n).
Proof.
  intros wall met base K. assert (forall c s, passable wall c s = true -> passable met c s = true) as P.
  { intros c s; unfold passable. destruct (met (edge_of c s)) eqn:E; [rewrite (K _ E); discriminate | reflexivity]. }
  assert (forall a c, In c (links wall a) -> In c (links met a)) as Q.
  { intros a c I; destruct (links_spec _ _ _ I) as [s [A [->|[t [T [B ->]]]]]]; [now apply beside_is_linked, P|].
    apply in_flat_map; exists s; split; [destruct s; cbn; auto|]. rewrite (P _ _ A).
    right; apply in_map, filter_In; auto. }
  induction n as [|n IH]; intros c I; [exact I|]. apply reached_S in I; apply reached_S.
  destruct I as [I|[a [A I]]]; [left; auto | right; exists a; auto].
Qed.

(** A run ends: in the map, whose walls are those that it has [met], no unexplored cell is within reach. *)
Definition ends (N : nat) (base : cell) (met : edge -> bool) (past : list team) : Prop :=
  forall c, In c (reached met base (N - 1)) -> explored N past c.

(** CHAIN-13. Of the walls of the map nothing is asked but that they are walls: Heard.v shows that. *)
Theorem CHAIN_13 : forall N rl base wall past st met, run N rl base wall past st ->
  (forall e, met e = true -> wall e = true) -> ends N base met past ->
  forall c, In c (reached wall base (N - 1)) -> explored N past c.
Proof. intros N rl base wall past st met _ K E c I; apply E; eapply reached_mono; eauto. Qed.
