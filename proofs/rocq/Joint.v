(** KIT-11 and KIT-14: two robots that keep in touch and drive a path again, for every lattice of nodes, every set of walls
    and every order of what they do.

    A robot that stands may drive through an uncovered side that is admitted, or through one with which a shortest way
    begins: its own while the other one drives a new path and it has one, and else the joint way. It looks for ways as
    the kernel does, level by level from all goals. The records are those of Sides.v, what is admitted that of Kit.v. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Kit Sides.
Import ListNotations.
Local Open Scope nat_scope.
Local Open Scope lazy_bool_scope.

(** ** Ways to a goal. *)
Section Nearest.
  Variables (A : Type) (same : A -> A -> bool) (all : list A) (moves : A -> list A) (goal : A -> bool).

  (** A way of so many moves. *)
  Fixpoint way (n : nat) (a : A) : Prop :=
    match n with O => goal a = true | S n => exists b, In b (moves a) /\ way n b end.
  Definition nearest (a : A) (n : nat) : Prop := way n a /\ forall m, m < n -> ~ way m a.

  Definition has (l : list A) (a : A) : bool := existsb (same a) l.
  (** Those of [l], and all from which one move leads there. *)
  Definition grown (l : list A) : list A := filter (fun a => has l a ||| existsb (has l) (moves a)) all.
  (** All that is nearer to a goal than [a]; [None] if [a] has no way. *)
  Fixpoint search (fuel : nat) (before now : list A) (a : A) : option (list A) :=
    if has now a then Some before
    else match fuel with
         | O => None
         | S fuel => let next := grown now in if length next =? length now then None else search fuel now next a
         end.
  Definition closer (a : A) : option (list A) := search (length all) [] (filter goal all) a.

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis closed : forall a b, In a all -> In b (moves a) -> In b all.

  Lemma has_spec : forall l a, has l a = true <-> In a l.
  Proof.
    intros l a; unfold has; rewrite existsb_exists; split; [intros [x [I E]]; apply same_spec in E; now subst|].
    intros I; exists a; split; [exact I | now apply same_spec].
  Qed.

  Fixpoint level (n : nat) : list A := match n with O => filter goal all | S n => grown (level n) end.

  Lemma level_spec : forall n a, In a (level n) <-> In a all /\ exists m, m <= n /\ way m a.
  Proof.
    induction n as [|n IH]; intros a; cbn [level].
    - rewrite filter_In; split; [intros [I G]; split; [exact I | exists 0; auto]|].
      intros [I [m [L W]]]; replace m with 0 in W by lia; auto.
    - unfold grown; rewrite filter_In. change (has (level n) a ||| existsb (has (level n)) (moves a))
        with (has (level n) a || existsb (has (level n)) (moves a)). rewrite orb_true_iff, has_spec, existsb_exists, IH.
      split.
      + intros [I [[_ [m [L W]]]|[b [M H]]]]; split; auto; [exists m; split; [lia | exact W]|].
        apply has_spec, IH in H; destruct H as [_ [m [L W]]]; exists (S m); split; [lia | exists b; auto].
      + intros [I [m [L W]]]; split; [exact I|]. destruct m as [|m]; [left; split; [exact I | exists 0; split;
          [lia | exact W]]|].
        destruct W as [b [M W]]; right; exists b; split; [exact M|]. apply has_spec, IH; split; [eapply closed; eauto|].
        exists m; split; [lia | exact W].
  Qed.

  Lemma filters_grow : forall (f g : A -> bool) l, (forall a, In a l -> f a = true -> g a = true) ->
    length (filter f l) <= length (filter g l) /\ (length (filter f l) = length (filter g l) -> filter f l = filter g l).
  Proof.
    intros f g l; induction l as [|a l IH]; intros H; cbn; [auto|]. destruct IH as [L E]; [firstorder|].
    specialize (H a (or_introl eq_refl)); destruct (f a), (g a); cbn.
    - split; [lia | intros X; f_equal; apply E; lia].
    - now specialize (H eq_refl).
    - split; [lia | intros X; lia].
    - split; [lia | intros X; now apply E].
  Qed.

  Lemma level_filter : forall n, exists f, level n = filter f all.
  Proof. intros [|n]; eexists; reflexivity. Qed.

  Lemma level_grows : forall n, level (S n) = level n \/ length (level n) < length (level (S n)).
  Proof.
    intros n; destruct (level_filter n) as [f F], (level_filter (S n)) as [g G].
    destruct (filters_grow f g all) as [L E].
    { intros a I H. assert (In a (level n)) as J by (rewrite F; now apply filter_In).
      assert (In a (level (S n))) as K; [|rewrite G in K; apply filter_In in K; tauto].
      apply level_spec in J; destruct J as [J [m [M W]]]; apply level_spec; split; [exact J | exists m; split;
        [lia | exact W]]. }
    rewrite <- F, <- G in L, E. destruct (Nat.eq_dec (length (level n)) (length (level (S n)))); [left; symmetry; auto|].
    right; lia.
  Qed.

  Lemma level_fixed : forall n, level (S n) = level n -> forall m, level (n + m) = level n.
  Proof.
    intros n E m; induction m as [|m IH]; [now rewrite Nat.add_0_r|]. rewrite Nat.add_succ_r; cbn [level] in *; now rewrite IH.
  Qed.

  Lemma search_spec : forall fuel n before a, In a all ->
    (forall b, In b before <-> In b all /\ exists m, m < n /\ way m b) -> (forall m, m < n -> ~ way m a) ->
    match search fuel before (level n) a with
    | Some l => exists k, nearest a k /\ forall b, In b l <-> In b all /\ exists m, m < k /\ way m b
    | None => forall m, m <= n + fuel -> ~ way m a
    end.
  Proof.
    induction fuel as [|fuel IH]; intros n before a I B F; cbn [search];
      (destruct (has (level n) a) eqn:H;
       [exists n; split; [|exact B]; apply has_spec, level_spec in H; destruct H as [_ [m [L W]]];
        destruct (Nat.eq_dec m n) as [->|D]; [split; auto | exfalso; apply (F m); [lia | exact W]]|]);
      assert (~ In a (level n)) as X by (intros J; apply has_spec in J; congruence); rewrite level_spec in X.
    - intros m L W; apply X; split; [exact I | exists m; split; [lia | exact W]].
    - specialize (IH (S n) (level n) a I). change (grown (level n)) with (level (S n)); cbv zeta.
      destruct (Nat.eqb_spec (length (level (S n))) (length (level n))) as [E|_].
      { intros m _ W; destruct (level_grows n) as [G|G]; [|lia]. rewrite <- level_spec in X; apply X.
        rewrite <- (level_fixed n G m); apply level_spec; split; [exact I | exists m; split; [lia | exact W]]. }
      destruct (search fuel (level n) (level (S n)) a).
      + apply IH; [|intros m L W; apply X; split; [exact I | exists m; split; [lia | exact W]]].
        intros b; rewrite level_spec; split; intros [J [m [L W]]]; (split; [exact J | exists m; split; [lia | exact W]]).
      + intros m L; apply IH; [| |lia].
        * intros b; rewrite level_spec; split; intros [J [k [K W]]]; (split; [exact J | exists k; split; [lia | exact W]]).
        * intros k K W; apply X; split; [exact I | exists k; split; [lia | exact W]].
  Qed.

  Lemma levels_stop : forall n, level (S n) = level n \/ n < length (level (S n)).
  Proof.
    induction n as [|n [IH|IH]]; [destruct (level_grows 0); [auto | right; lia] | left; cbn [level] in *; now rewrite IH |].
    destruct (level_grows (S n)); [auto | right; lia].
  Qed.

  (** As many levels as there are places are enough. *)
  Lemma closer_spec : forall a, In a all ->
    match closer a with
    | Some l => exists k, nearest a k /\ forall b, In b l <-> In b all /\ exists m, m < k /\ way m b
    | None => forall m, ~ way m a
    end.
  Proof.
    intros a I; unfold closer; pose proof (search_spec (length all) 0 [] a I) as S0; cbn [level] in S0.
    destruct (search (length all) [] (filter goal all) a) as [l|].
    - apply S0; [|lia]. intros b; split; [intros [] | intros [_ [m [L _]]]; lia].
    - assert (forall m, m <= length all -> ~ way m a) as F.
      { apply S0; [|lia]. intros b; split; [intros [] | intros [_ [m [L _]]]; lia]. }
      assert (level (S (length all)) = level (length all)) as E.
      { destruct (levels_stop (length all)) as [E|L]; [exact E|]. exfalso. destruct (level_filter (S (length all))) as [f F'].
        assert (forall l, length (filter f l) <= length l) as G.
        { induction l as [|b l IH]; cbn; [lia|]. destruct (f b); cbn; lia. }
        specialize (G all); rewrite F' in L; lia. }
      intros m W. assert (In a (level (length all + m))) as J by (apply level_spec; split; [exact I | exists m; split;
        [lia | exact W]]).
      rewrite (level_fixed _ E) in J; apply level_spec in J; destruct J as [_ [k [K V]]]; now apply (F k).
  Qed.

  (** One move nearer. *)
  Lemma closer_move : forall a b l, In a all -> In b (moves a) -> closer a = Some l ->
    (In b l <-> exists n, nearest a (S n) /\ nearest b n).
  Proof.
    intros a b l I M E; pose proof (closer_spec a I) as C; rewrite E in C; destruct C as [k [[W F] C]].
    rewrite C; clear C E. pose proof (closed a b I M) as J; split.
    - intros [_ [m [L V]]]; pose proof (closer_spec b J) as C. destruct (closer b) as [l'|]; [|exfalso; now apply (C m)].
      destruct C as [n [[V' F'] _]]; exists n.
      assert (n <= m) by (destruct (Nat.le_gt_cases n m); [assumption | exfalso; now apply (F' m)]).
      assert (way (S n) a) as X by (exists b; auto).
      replace (S n) with k; [split; split; auto|]. destruct (Nat.lt_trichotomy k (S n)) as [?|[?|H']]; [lia | auto |].
      exfalso; now apply (F (S n)).
    - intros [n [[V F'] [V' _]]]; split; [exact J|]; exists n; split; [|exact V'].
      destruct (Nat.lt_trichotomy k (S n)) as [H|[->|H]]; [exfalso; now apply (F' k) | lia | exfalso; now apply (F (S n))].
  Qed.
End Nearest.

(** ** Two robots. *)
Definition side_eqb (s t : side) : bool :=
  match s, t with East, East | South, South | West, West | North, North => true | _, _ => false end.
(** A robot may drive through side [s] of [c] with the other one there. *)
Definition lets (c : cell) (other : stance) (s : side) : bool := admits_two REPAIRED (Stands c) other s.

Definition pair : Type := cell * cell.
Definition same_pair (p q : pair) : bool := cell_eqb (fst p) (fst q) && cell_eqb (snd p) (snd q).
(** Where robot [i] is, and where both are when it has come to [c]. *)
Definition of (p : pair) (i : nat) : cell := match i with O => fst p | S _ => snd p end.
Definition moved (p : pair) (i : nat) (c : cell) : pair := match i with O => (c, snd p) | S _ => (fst p, c) end.

Section Two.
  Variables (cells : list cell) (border wall : edge -> bool).

  Section Now.
    Variable w : world.

    Definition driven_sides (c : cell) : list side := filter (is_driven 2 w c) all_sides.
    Definition uncovered_sides (c : cell) : list side := filter (uncovered 2 border w c) all_sides.

    (** The joint way: single drives over paths that were driven, both in contact and at different nodes, until an
        uncovered side is admitted for one of them. *)
    Definition lets_of (p : pair) (i : nat) (s : side) : bool := lets (of p i) (Stands (of p (1 - i))) s.
    Definition joint_moves (p : pair) : list pair :=
      flat_map (fun i => map (fun s => moved p i (beyond (of p i) s)) (filter (lets_of p i) (driven_sides (of p i))))
        [0; 1].
    Definition joint_goal (p : pair) : bool :=
      existsb (fun i => existsb (lets_of p i) (uncovered_sides (of p i))) [0; 1].
    Definition joint_places : list pair :=
      filter (fun p => in_reach (fst p) (snd p) && negb (cell_eqb (fst p) (snd p))) (list_prod cells cells).

    (** The way of one alone, while the other one is as it is. *)
    Definition own_moves (other : stance) (c : cell) : list cell := map (beyond c) (filter (lets c other) (driven_sides c)).
    Definition own_goal (other : stance) (c : cell) : bool := existsb (lets c other) (uncovered_sides c).

    Definition ends : pair := (next (stances w 0), next (stances w 1)).
    Definition drives_new (i : nat) : bool :=
      fresh w i && match stances w i with Stands _ => false | Drives _ _ => true end.

    (** The sides with which a shortest way begins; [None] if there is no way. *)
    Definition own_part (i : nat) (c : cell) : option (list side) :=
      let other := stances w (1 - i) in
      option_map (fun near => filter (fun s => lets c other s &&& has cell cell_eqb near (beyond c s)) (driven_sides c))
        (closer cell cell_eqb cells (own_moves other) (own_goal other) c).
    Definition joint_part (i : nat) (c : cell) : option (list side) :=
      let other := stances w (1 - i) in
      option_map (fun near => filter (fun s => lets c other s
          &&& has pair same_pair near (moved ends i (beyond c s))) (driven_sides c))
        (closer pair same_pair joint_places joint_moves joint_goal ends).
    Definition part (i : nat) (c : cell) : option (list side) :=
      match (if drives_new (1 - i) then own_part i c else None) with Some l => Some l | None => joint_part i c end.
  End Now.

  (** The drives that the rule lets a robot begin: new ones, and old ones of its part. *)
  Definition may (w : world) (i : nat) (s : side) : bool :=
    match stances w i with
    | Stands c => lets c (stances w (1 - i)) s
        &&& (uncovered 2 border w c s ||| match part w i c with Some l => existsb (side_eqb s) l | None => false end)
    | Drives _ _ => false
    end.

  (** The robots start at different nodes in contact. *)
  Definition may_start (t : team) : Prop :=
    (forall i, i < 2 -> exists c, t i = Stands c /\ In c cells) /\ connected 2 t /\ apart 2 t.
  Definition two : list event -> world -> Prop := Sides.run 2 MARKED wall may may_start.

  (** No open path leads out of the area. *)
  Hypothesis inside : forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells.

  (** What they do is a run of Kit.v: so KIT-1 and KIT-3 hold. *)
  Theorem two_keep_in_touch : forall l w, two l w -> Kit.run 2 (stances w).
  Proof.
    intros l w R; induction R as [t [S [C A]]|l w e w' R IH A].
    { cbn; apply Kit.run_start; auto. intros i L; destruct (S i L) as [c [E _]]; eauto. }
    destruct e as [i c s|i c s|i c s|i]; cbn [act] in A.
    - destruct (is_at 2 w i c) eqn:At; [|discriminate]. destruct (wall (edge_of c s)); [discriminate|].
      destruct (may w i s) eqn:M; [|discriminate]. injection A as <-; cbn [stances].
      unfold is_at in At; apply andb_true_iff in At; destruct At as [L At]; apply Nat.ltb_lt in L.
      destruct (stances w i) as [d|] eqn:E; [|discriminate]. apply cell_eqb_spec in At; subst d.
      apply Kit.run_drive; auto. apply admits_two_is_admits; [exact L|]. unfold may in M; rewrite E in *.
      destruct (lets c (stances w (1 - i)) s) eqn:X; [exact X | discriminate].
    - destruct (is_at 2 w i c && wall (edge_of c s)); [|discriminate]. injection A as <-; exact IH.
    - destruct (is_at 2 w i c && negb (wall (edge_of c s))); [|discriminate]. injection A as <-; exact IH.
    - destruct (stances w i) as [c|c s] eqn:E; [discriminate|]. destruct (Nat.ltb_spec i 2) as [L|]; [|discriminate].
      injection A as <-; cbn [stances]; now apply Kit.run_arrive.
  Qed.

  (** Where robots are and what was driven lies in the area. *)
  Lemma two_inside : forall l w, two l w -> (forall i, i < 2 -> In (left_ (stances w i)) cells /\ In (next (stances w i)) cells).
  Proof.
    intros l w R; induction R as [t [S _]|l w e w' R IH A].
    { intros i L; destruct (S i L) as [c [E I]]; cbn; rewrite E; auto. }
    destruct e as [i c s|i c s|i c s|i]; cbn [act] in A.
    - destruct (is_at 2 w i c) eqn:At; [|discriminate]. destruct (wall (edge_of c s)) eqn:W; [discriminate|].
      destruct (may w i s) eqn:M; [|discriminate]. injection A as <-; cbn [stances].
      unfold is_at in At; apply andb_true_iff in At; destruct At as [L At]; apply Nat.ltb_lt in L.
      destruct (stances w i) as [d|] eqn:E; [|discriminate]. apply cell_eqb_spec in At; subst d.
      intros j Lj; destruct (Nat.eq_dec j i) as [->|D]; [rewrite Kit.put_same | rewrite Kit.put_other by exact D; auto].
      specialize (IH i L); rewrite E in IH; cbn in *; split; [tauto | apply inside; tauto].
    - destruct (is_at 2 w i c && wall (edge_of c s)); [|discriminate]. injection A as <-; exact IH.
    - destruct (is_at 2 w i c && negb (wall (edge_of c s))); [|discriminate]. injection A as <-; exact IH.
    - destruct (stances w i) as [c|c s] eqn:E; [discriminate|]. destruct (Nat.ltb_spec i 2) as [L|]; [|discriminate].
      injection A as <-; cbn [stances]; intros j Lj.
      destruct (Nat.eq_dec j i) as [->|D]; [rewrite Kit.put_same | rewrite Kit.put_other by exact D; auto].
      specialize (IH i L); rewrite E in IH; cbn in *; tauto.
  Qed.

  Lemma driven_inside : forall l w, two l w -> forall c s, In c cells -> is_driven 2 w c s = true -> In (beyond c s) cells.
  Proof.
    intros l w R c s I D; unfold is_driven in D; apply in_records_spec in D; destruct D as [i [_ D]].
    destruct (recorded _ _ _ _ _ _ _ R) as [H [_ [W _]]]. apply H in D; destruct D as [d [u [D E]]].
    apply W in D; destruct D as [_ D]. apply inside; [exact I | now rewrite <- E].
  Qed.

  Lemma driven_sides_spec : forall w c s, In s (driven_sides w c) <-> is_driven 2 w c s = true.
  Proof. intros w c s; unfold driven_sides; rewrite filter_In; split; [tauto|]. split; [destruct s; cbn; auto | assumption]. Qed.

  Lemma same_pair_spec : forall p q, same_pair p q = true <-> p = q.
  Proof.
    intros [a b] [c d]; unfold same_pair; cbn; rewrite andb_true_iff, !cell_eqb_spec.
    split; [intros [-> ->]; reflexivity | intros H; injection H; auto].
  Qed.

  Lemma lets_reach : forall c d s, in_reach c d = true -> lets c (Stands d) s = true ->
    in_reach (beyond c s) d = true /\ cell_eqb (beyond c s) d = false.
  Proof.
    intros c d s _ L; unfold lets, admits_two in L; cbn in L; rewrite !andb_true_iff, negb_true_iff in L.
    destruct L as [[L _] H]; split; [exact L|]. unfold Kit.has in H; cbn in H; rewrite orb_diag in H.
    destruct (cell_eqb (beyond c s) d) eqn:E; [|reflexivity]. apply cell_eqb_spec in E; rewrite <- E in H.
    assert (cell_eqb (beyond c s) (beyond c s) = true) as X by now apply cell_eqb_spec. congruence.
  Qed.

  (** A drive that is admitted while the other one drives is admitted when it has come. *)
  Lemma lets_next : forall c x s, lets c x s = true -> lets c (Stands (next x)) s = true.
  Proof.
    intros c x s L; unfold lets, admits_two, Kit.has in *; cbn in *; rewrite !andb_true_iff, !negb_true_iff, !orb_false_iff in *.
    intuition.
  Qed.

  Lemma cell_eqb_sym : forall a b, cell_eqb a b = cell_eqb b a.
  Proof. intros a b; unfold cell_eqb; now rewrite (Z.eqb_sym (fst a)), (Z.eqb_sym (snd a)). Qed.

  Lemma joint_closed : forall l w, two l w -> forall p q, In p joint_places -> In q (joint_moves w p) -> In q joint_places.
  Proof.
    intros l w R [a b] q I M; unfold joint_places in *; rewrite filter_In in *; destruct I as [I C].
    apply in_prod_iff in I; destruct I as [Ia Ib]; cbn [fst snd] in *. apply andb_true_iff in C; destruct C as [C _].
    unfold joint_moves in M; apply in_flat_map in M; destruct M as [i [Hi M]]; apply in_map_iff in M.
    destruct M as [s [<- M]]; apply filter_In in M; destruct M as [D L]; apply driven_sides_spec in D; unfold lets_of in L.
    destruct Hi as [<-|[<-|[]]]; cbn [of moved fst snd Nat.sub] in *.
    - destruct (lets_reach _ _ _ C L) as [X Y]; rewrite X, Y; split; [apply in_prod_iff; split; auto; eapply driven_inside; eauto
        | reflexivity].
    - rewrite in_reach_sym in C. destruct (lets_reach _ _ _ C L) as [X Y]; rewrite in_reach_sym in X; rewrite cell_eqb_sym in Y.
      rewrite X, Y; split; [apply in_prod_iff; split; auto; eapply driven_inside; eauto | reflexivity].
  Qed.

  Lemma own_closed : forall l w, two l w -> forall x a b, In a cells -> In b (own_moves w x a) -> In b cells.
  Proof.
    intros l w R x a b I M; unfold own_moves in M; apply in_map_iff in M; destruct M as [s [<- M]].
    apply filter_In in M; destruct M as [D _]; apply driven_sides_spec in D; eapply driven_inside; eauto.
  Qed.

  Lemma ends_are_places : forall l w, two l w -> In (ends w) joint_places.
  Proof.
    intros l w R; unfold joint_places; apply filter_In; unfold ends; cbn [fst snd]; split.
    - apply in_prod_iff; split; apply (two_inside _ _ R); lia.
    - pose proof (two_keep_in_touch _ _ R) as K. destruct (KIT_1 _ K) as [S _].
      destruct (KIT_3 2 _ K 0 1) as [A _]; [lia..|]. unfold is_sure_of in S; rewrite !andb_true_iff in S.
      unfold is_apart_from, Kit.has in A; rewrite !andb_true_iff, !negb_true_iff, !orb_false_iff in A.
      destruct S as [_ ->], A as [_ [_ A]]; cbn [andb]. rewrite cell_eqb_sym, A; reflexivity.
  Qed.

  (** What begins a shortest way of robot [i], which stands at [c]: its own, if it may go alone and has one; else the
      joint one. *)
  Section Shortest.
    Variables (w : world) (i : nat) (c : cell).
    Let other : stance := stances w (1 - i).
    Definition own_nearest : cell -> nat -> Prop := nearest cell (own_moves w other) (own_goal w other).
    Definition joint_nearest : pair -> nat -> Prop := nearest pair (joint_moves w) (joint_goal w).
    Definition goes_alone : Prop := drives_new w (1 - i) = true /\ exists n, own_nearest c n.
    Definition shortens_own (s : side) : Prop := exists n, own_nearest c (S n) /\ own_nearest (beyond c s) n.
    Definition shortens_joint (s : side) : Prop :=
      exists n, joint_nearest (ends w) (S n) /\ joint_nearest (moved (ends w) i (beyond c s)) n.
  End Shortest.

  Lemma old_drives : forall l w i c s, two l w -> i < 2 -> stances w i = Stands c -> is_driven 2 w c s = true ->
    (may w i s = true <-> lets c (stances w (1 - i)) s = true
       /\ (goes_alone w i c /\ shortens_own w i c s \/ ~ goes_alone w i c /\ shortens_joint w i c s)).
  Proof.
    intros l w i c s R L E D. unfold may; rewrite E.
    replace (uncovered 2 border w c s) with false by (unfold uncovered; now rewrite D).
    set (x := stances w (1 - i)). destruct (lets c x s) eqn:A; [|split; [discriminate | intros [X _]; discriminate X]].
    assert (forall l, existsb (side_eqb s) l = true <-> In s l) as SE.
    { intros l'; rewrite existsb_exists; split; [intros [t [I H]]; destruct s, t; (discriminate || exact I)|].
      intros I; exists s; split; [exact I | now destruct s]. }
    assert (In c cells) as Ic by (pose proof (two_inside _ _ R i L) as X; rewrite E in X; cbn in X; tauto).
    pose proof (closer_spec cell cell_eqb cells (own_moves w x) (own_goal w x) cell_eqb_spec (own_closed _ _ R x) c Ic) as Own.
    assert (In (beyond c s) (own_moves w x c)) as Mo.
    { unfold own_moves; apply in_map, filter_In; split; [now apply driven_sides_spec | exact A]. }
    pose proof (fun l => closer_move cell cell_eqb cells (own_moves w x) (own_goal w x) cell_eqb_spec (own_closed _ _ R x)
      c (beyond c s) l Ic Mo) as OwnM.
    pose proof (ends_are_places _ _ R) as Ip.
    pose proof (closer_spec pair same_pair joint_places (joint_moves w) (joint_goal w) same_pair_spec (joint_closed _ _ R)
      (ends w) Ip) as Jo.
    assert (In (moved (ends w) i (beyond c s)) (joint_moves w (ends w))) as Mj.
    { unfold joint_moves; apply in_flat_map; exists i; split; [cbn; lia|]. apply in_map_iff; exists s.
      assert (of (ends w) i = c) as Oi by (destruct i as [|[|]]; [| |lia]; cbn [of ends fst snd]; now rewrite E).
      rewrite Oi; split; [reflexivity|]. apply filter_In; split; [now apply driven_sides_spec|].
      unfold lets_of; rewrite Oi. replace (of (ends w) (1 - i)) with (next x); [now apply lets_next|].
      unfold x; destruct i as [|[|]]; [reflexivity | reflexivity | lia]. }
    pose proof (fun l => closer_move pair same_pair joint_places (joint_moves w) (joint_goal w) same_pair_spec
      (joint_closed _ _ R) (ends w) (moved (ends w) i (beyond c s)) l Ip Mj) as JoM.
    assert (match joint_part w i c with Some l => existsb (side_eqb s) l | None => false end = true
            <-> shortens_joint w i c s) as Joint.
    { unfold joint_part; fold x. destruct (closer pair same_pair joint_places (joint_moves w) (joint_goal w) (ends w)) as [l'|];
        cbn [option_map].
      - rewrite SE, filter_In, A, (has_spec _ _ same_pair_spec), (JoM l' eq_refl), driven_sides_spec. unfold shortens_joint,
          joint_nearest; tauto.
      - split; [discriminate|]. intros [n [[W _] _]]; exfalso; now apply (Jo (S n)). }
    unfold part, goes_alone; destruct (drives_new w (1 - i)).
    - unfold own_part; fold x. destruct (closer cell cell_eqb cells (own_moves w x) (own_goal w x) c) as [l'|]; cbn [option_map].
      + destruct Own as [k [Own _]]. assert (exists n, own_nearest w i c n) as Ex by (exists k; exact Own).
        rewrite SE, filter_In, A, (has_spec _ _ cell_eqb_spec), (OwnM l' eq_refl), driven_sides_spec.
        unfold shortens_own, own_nearest; fold x; intuition.
      + rewrite Joint. assert (~ exists n, own_nearest w i c n) as Ex by (intros [n [W _]]; now apply (Own n)). intuition.
    - rewrite Joint. intuition discriminate.
  Qed.
End Two.

(** A robot that drives a path again shortens the joint way, or its own while the other one drives a new path. *)
Theorem KIT_11 : forall cells border wall,
  (forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells) ->
  forall l w, two cells border wall l w -> forall i c s, i < 2 -> stances w i = Stands c ->
  is_driven 2 w c s = true -> may cells border w i s = true ->
  shortens_joint border w i c s \/ drives_new w (1 - i) = true /\ shortens_own border w i c s.
Proof.
  intros cells border wall I l w R i c s L E D M.
  apply (old_drives cells border wall I l w i c s R L E D) in M; unfold goes_alone in M; tauto.
Qed.

(** It may take each side that is admitted and begins a shortest way, and no other. *)
Theorem KIT_14 : forall cells border wall,
  (forall c s, In c cells -> wall (edge_of c s) = false -> In (beyond c s) cells) ->
  forall l w, two cells border wall l w -> forall i c s, i < 2 -> stances w i = Stands c -> is_driven 2 w c s = true ->
  (may cells border w i s = true
   <-> lets c (stances w (1 - i)) s = true
       /\ (goes_alone border w i c /\ shortens_own border w i c s
           \/ ~ goes_alone border w i c /\ shortens_joint border w i c s)).
Proof. intros cells border wall I l w R i c s L E D; eapply old_drives; eauto. Qed.

(** ** Robots that drive any path again do not shorten it. *)
Definition any_path (w : world) (i : nat) (s : side) : bool :=
  match stances w i with Stands c => lets c (stances w (1 - i)) s | Drives _ _ => false end.

Theorem any_path_breaks_KIT_11 : exists l w c s,
  Sides.run 2 MARKED nowhere any_path (fun t => t = standing (0, 0)%Z (3, 0)%Z) l w /\ stances w 0 = Stands c
  /\ is_driven 2 w c s = true /\ any_path w 0 s = true
  /\ ~ (shortens_joint nowhere w 0 c s \/ drives_new w 1 = true /\ shortens_own nowhere w 0 c s).
Proof.
  exists [Comes 0; Leaves 0 (0, 0)%Z East]; eexists; exists (1, 0)%Z, West.
  split; [eapply run_goes_on; [eapply run_goes_on; [now apply run_begins | reflexivity] | reflexivity]|].
  split; [reflexivity|]. split; [reflexivity|]. split; [reflexivity|].
  intros [[n [[_ F] _]]|[H _]]; [apply (F 0); [lia | reflexivity] | discriminate].
Qed.
