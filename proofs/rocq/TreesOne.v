(** Helpers by the table of the rule, as long as there is one tree: BRICKS-10, for every number of them, every finite
    floor and every order of turns. AloneTie.v compares the kernel. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Trees TreesAlone.
From Tautline Require Ants.
Import ListNotations.

Section Team.
  Variables (cell : Type) (same : cell -> cell -> bool) (beside : cell -> cell -> Prop) (cells : list cell).
  Notation floor := (Trees.floor cell).
  Notation Wall := (Trees.Wall cell). Notation Open := (Trees.Open cell). Notation Visited := (Trees.Visited cell).
  Notation Unexplored := (Trees.Unexplored cell). Notation Explored := (Trees.Explored cell).

  (** A run of [n] helpers: the floor, the labels, where they are until they are done, and the turns, the last one
      first: whose, and where it went. *)
  Definition put (w : nat -> option cell) (i : nat) (p : option cell) : nat -> option cell :=
    fun j => if j =? i then p else w j.
  Inductive run (n : nat) : floor -> list nat -> (nat -> option cell) -> list (nat * option cell) -> Prop :=
  | begins : forall f w, (forall c, f c = Wall \/ f c = Unexplored \/ f c = Explored) ->
      (forall c, f c <> Wall -> In c cells) -> (forall i, i < n -> exists c, w i = Some c /\ f c = Explored) ->
      run n f [] w []
  | then_ : forall f used w past i c g used' next, run n f used w past -> i < n -> w i = Some c ->
      act cell beside f used c g used' next -> run n g used' (put w i next) ((i, next) :: past).

  (** How many moves a helper has made. *)
  Definition moves_of (i : nat) (past : list (nat * option cell)) : nat :=
    length (filter (fun t => (fst t =? i) && match snd t with Some _ => true | None => false end) past).

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.

  (** The parent of a cell that has been of the tree, and the cells from there up to the root. *)
  Definition parent (f : floor) (c : cell) : option (option cell) :=
    match f c with Trees.Open _ _ q | Trees.Visited _ q => Some q | _ => None end.
  Fixpoint chain (f : floor) (c : cell) (l : list cell) : Prop :=
    match l with [] => parent f c = Some None | p :: l => parent f c = Some (Some p) /\ chain f p l end.

  (** What an action leaves as it is. *)
  Definition keeps (f g : floor) : Prop := forall d, match f d with
    | Trees.Wall _ => g d = Wall
    | Trees.Unexplored _ => True
    | Trees.Explored _ => g d = Explored \/ parent g d <> None
    | Trees.Open _ m q => g d = Open m q \/ g d = Visited q
    | Trees.Visited _ q => g d = Visited q
    end.

  Lemma keeps_parent : forall f g d q, keeps f g -> parent f d = Some q -> parent g d = Some q.
  Proof.
    intros f g d q K; specialize (K d); unfold parent at 1; destruct (f d); try discriminate; intros E;
      injection E as ->; unfold parent; [destruct K as [->| ->] | rewrite K]; reflexivity.
  Qed.
  Lemma keeps_trans : forall f g h, keeps f g -> keeps g h -> keeps f h.
  Proof.
    intros f g h K L d; pose proof (K d) as Kd; pose proof (L d) as Ld. destruct (f d); auto.
    - now rewrite Kd in Ld.
    - destruct Kd as [Kd|Kd]; [now rewrite Kd in Ld|]. right; destruct (parent g d) as [q|] eqn:P; [|contradiction].
      rewrite (keeps_parent _ _ _ _ L P); discriminate.
    - destruct Kd as [Kd|Kd]; rewrite Kd in Ld; auto.
    - now rewrite Kd in Ld.
  Qed.
  Lemma keeps_same : forall f, keeps f f.
  Proof. intros f d; destruct (f d); auto. Qed.

  Lemma chain_keeps : forall f g l c, keeps f g -> chain f c l -> chain g c l.
  Proof.
    intros f g l; induction l as [|p l IH]; intros c K C; cbn in *; [now apply (keeps_parent f g)|].
    destruct C as [P C]; split; [now apply (keeps_parent f g) | auto].
  Qed.
  Lemma chain_one : forall f l k c, chain f c l -> chain f c k -> l = k.
  Proof.
    intros f l; induction l as [|p l IH]; intros [|q k] c C D; cbn in *; [reflexivity | destruct D; congruence
      | destruct C; congruence|]. destruct C as [P C], D as [Q D]. rewrite P in Q; injection Q as <-. f_equal; eauto.
  Qed.
  Lemma chain_parents : forall f l c d, chain f c l -> In d (c :: l) -> parent f d <> None.
  Proof.
    intros f l; induction l as [|p l IH]; intros c d C I; cbn in C; destruct I as [<-|I]; try (destruct I; fail).
    - congruence.
    - destruct C as [-> _]; discriminate.
    - destruct C as [_ C]; eauto.
  Qed.

  (** Every cell of the tree has its way up to the root. *)
  Record good (f : floor) (used : list nat) : Prop := {
    inside : forall c, f c <> Wall -> In c cells;
    labels : forall c l q, f c = Open l q -> In l used;
    climbs : forall c, parent f c <> None -> exists l, chain f c l /\ NoDup (c :: l);
  }.

  Lemma cell_dec : forall a b : cell, a = b \/ a <> b.
  Proof.
    intros a b; destruct (same a b) eqn:E; [left; now apply same_spec|]. right; intros ->.
    rewrite (proj2 (same_spec b b) eq_refl) in E; discriminate.
  Qed.

  (** A cell gets its parent, which is of the tree, or becomes the root. *)
  Lemma opens : forall f used g used' c m par, good f used -> f c = Unexplored \/ f c = Explored ->
    match par with Some p => parent f p <> None | None => True end -> becomes cell f c (Open m par) g ->
    incl used used' -> In m used' -> keeps f g /\ good g used'.
  Proof.
    intros f used g used' c m par [I L C] N P [Gc Go] U M.
    assert (forall d, d = c \/ g d = f d) as D by (intros d; destruct (cell_dec d c); auto).
    assert (keeps f g) as K.
    { intros d; destruct (D d) as [->| ->]; [|destruct (f d); auto]. destruct N as [-> | ->]; [exact Logic.I|].
      right; unfold parent; rewrite Gc; discriminate. }
    split; [exact K|]. split.
    - intros d X; apply I; destruct (D d) as [->|E]; [destruct N as [-> | ->]; discriminate | now rewrite <- E].
    - intros d l q E; destruct (D d) as [->|E']; [rewrite Gc in E; injection E as <- _; exact M|].
      rewrite E' in E; apply U; eauto.
    - intros d X; destruct (D d) as [->|E].
      + assert (parent f c = None) as O by (unfold parent; now destruct N as [-> | ->]).
        destruct par as [p|];
          [|exists []; split; [unfold chain, parent; now rewrite Gc | repeat constructor; intros []]].
        destruct (C p P) as [l [Cl Ul]]. exists (p :: l); split; [split; [unfold parent; now rewrite Gc |]|].
        * now apply (chain_keeps f).
        * constructor; [|exact Ul]. intros J; now apply (chain_parents f l p c Cl J).
      + assert (parent f d <> None) as X' by (unfold parent in *; now rewrite E in X).
        destruct (C d X') as [l [Cl Ul]]. exists l; split; [now apply (chain_keeps f) | exact Ul].
  Qed.

  Lemma joined_one : forall f used c g used' m, good f used -> joined cell beside f used c g used' m ->
    keeps f g /\ good g used' /\ exists q, g c = Open m q.
  Proof.
    intros f used c g used' m G J; destruct J as [m q F | p m q g F B P N H | m g F N U H].
    - split; [apply keeps_same|]. eauto.
    - destruct (opens f used g used c m (Some p) G) as [K G']; auto.
      + unfold parent; rewrite P; discriminate.
      + intros l I; exact I.
      + eapply labels; eauto.
      + split; [exact K|]. split; [exact G'|]. exists (Some p); apply H.
    - destruct (opens f used g (m :: used) c m None G) as [K G']; auto; [intros l I; now right | now left|].
      split; [exact K|]. split; [exact G'|]. exists None; apply H.
  Qed.

  (** Where a helper goes with one tree: to a child, or from a visited cell to the parent. *)
  Definition up_or_down (g : floor) (c : cell) (next : option cell) : Prop := match next with
    | Some d => (exists m, g d = Open m (Some c)) \/ g c = Visited (Some d)
    | None => True
    end.

  Lemma helps_one : forall f used c m q g next, good f used -> length used <= 1 -> f c = Open m q ->
    helps cell beside f c m g next -> keeps f g /\ good g used /\ up_or_down g c next.
  Proof.
    intros f used c m q g next G O F H. pose proof (labels _ _ G _ _ _ F) as M.
    assert (forall l, In l used -> l = m) as ONE
      by (intros l I; destruct used as [|a [|b u]]; cbn in *; try lia; destruct I, M; subst; tauto).
    assert (parent f c <> None) as P by (unfold parent; rewrite F; discriminate).
    assert (forall d, f d = Unexplored \/ f d = Explored -> becomes cell f d (Open m (Some c)) g ->
      keeps f g /\ good g used /\ up_or_down g c (Some d)) as CHILD.
    { intros d N B; destruct (opens f used g used d m (Some c) G N P B) as [K G']; [intros l I; exact I | exact M|].
      split; [exact K|]. split; [exact G'|]. left; exists m; apply B. }
    destruct H as [d g B E H | d g N B E H | d N N' L B [n E] | d N N' L H B [n [r [E K]]] | r g N N' L H H' F' B].
    - apply CHILD; auto.
    - apply CHILD; [|exact H]. destruct E as [E|[_ [l [r [E X]]]]]; [auto|].
      pose proof (ONE l (labels _ _ G _ _ _ E)); lia.
    - split; [apply keeps_same|]. split; [exact G|]. left; eauto.
    - pose proof (ONE n (labels _ _ G _ _ _ E)); lia.
    - rewrite F in F'; injection F' as <-. destruct B as [Gc Go].
      assert (forall d, d = c \/ g d = f d) as D by (intros d; destruct (cell_dec d c); auto).
      assert (keeps f g) as K
        by (intros d; destruct (D d) as [->| ->]; [rewrite F; auto | destruct (f d); auto]).
      destruct G as [I L' C]. split; [exact K|]. split; [split|].
      + intros d X; apply I; destruct (D d) as [->|E]; [congruence | now rewrite <- E].
      + intros d l s E; destruct (D d) as [->|E']; [congruence|]. rewrite E' in E; eauto.
      + intros d X; assert (parent f d <> None) as Y
          by (destruct (D d) as [->|E]; [exact P | unfold parent in *; now rewrite E in X]).
        destruct (C d Y) as [l [Cl Ul]]. exists l; split; [now apply (chain_keeps f) | exact Ul].
      + destruct q; [now right | exact Logic.I].
  Qed.

  Lemma act_one : forall f used c g used' next, good f used -> length used' <= 1 ->
    act cell beside f used c g used' next -> keeps f g /\ good g used' /\ parent g c <> None /\ up_or_down g c next.
  Proof.
    intros f used c g used' next G O A; destruct A as [e F | g used' m h next J H].
    - split; [apply keeps_same|]. split; [exact G|]. split; [unfold parent; rewrite F; discriminate|].
      destruct e; [now right | exact Logic.I].
    - destruct (joined_one _ _ _ _ _ _ G J) as [K [G' [q F]]]. destruct (helps_one _ _ _ _ _ _ _ G' O F H) as [K' X].
      split; [now apply (keeps_trans f g)|]. destruct X as [X Y]. split; [exact X|]. split; [|exact Y].
      rewrite (keeps_parent _ _ c q K'); [discriminate|]. unfold parent; now rewrite F.
  Qed.

  (** How many moves are left to a helper below the cells [a]: one up from each of these, two for each other that is not
      visited. *)
  Definition moves_for (f : floor) (a : list cell) (d : cell) : nat :=
    if existsb (same d) a then 1 else match f d with Trees.Wall _ | Trees.Visited _ _ => 0 | _ => 2 end.
  Definition moves_left (f : floor) (a : list cell) : nat := Ants.sum cell cells (moves_for f a).

  Lemma is_among : forall a d, existsb (same d) a = true <-> In d a.
  Proof.
    intros a d; rewrite existsb_exists; split; [intros [x [I E]]; apply same_spec in E; now subst|].
    intros I; exists d; split; [exact I | now apply same_spec].
  Qed.
  Lemma first_among : forall a d, existsb (same d) (d :: a) = true.
  Proof. intros a d; apply is_among; now left. Qed.
  Lemma not_among : forall a d, ~ In d a -> existsb (same d) a = false.
  Proof. intros a d N; destruct (existsb (same d) a) eqn:E; [|reflexivity]. apply is_among in E; contradiction. Qed.
  Lemma left_most : forall f a, moves_left f a <= 2 * length cells.
  Proof.
    intros f a; rewrite Nat.mul_comm; apply Ants.sum_most; intros d _; unfold moves_for.
    destruct (existsb (same d) a); [lia | destruct (f d); lia].
  Qed.
  Lemma left_keeps : forall f g a, keeps f g -> moves_left g a <= moves_left f a.
  Proof.
    intros f g a K; apply Ants.sum_le; intros d _; unfold moves_for. destruct (existsb (same d) a); [lia|].
    specialize (K d); destruct (f d); try (rewrite K; lia); destruct (g d); lia.
  Qed.

  Definition held (f : floor) (c : cell) (moves : nat) : Prop :=
    f c = Explored /\ moves = 0 \/ exists l, chain f c l /\ moves + moves_left f (c :: l) <= 2 * length cells.

  Lemma held_keeps : forall f g used c k, keeps f g -> good g used -> held f c k -> held g c k.
  Proof.
    intros f g used c k K G [[E ->]|[l [C B]]].
    - pose proof (K c) as Kc; rewrite E in Kc. destruct Kc as [Kc|P]; [now left|].
      destruct (climbs _ _ G c P) as [l [C _]]. right; exists l; split; [exact C|]. apply left_most.
    - right; exists l; split; [now apply (chain_keeps f)|]. pose proof (left_keeps f g (c :: l) K); lia.
  Qed.

  Lemma goes_held : forall g used c d k, good g used -> parent g c <> None -> held g c k -> up_or_down g c (Some d) ->
    held g d (S k).
  Proof.
    intros g used c d k G P H U. destruct (climbs _ _ G c P) as [l [C N]].
    assert (k + moves_left g (c :: l) <= 2 * length cells) as B.
    { destruct H as [[E _]|[l' [C' B]]]; [unfold parent in P; rewrite E in P; contradiction|].
      now rewrite (chain_one _ _ _ _ C C'). }
    assert (forall x, g x <> Wall -> In x cells) as I by apply G.
    right; destruct U as [[m E]|E].
    - assert (chain g d (c :: l)) as D by (split; [unfold parent; now rewrite E | exact C]).
      exists (c :: l); split; [exact D|].
      assert (~ In d (c :: l)) as X.
      { destruct (climbs _ _ G d) as [l' [C' N']]; [unfold parent; rewrite E; discriminate|].
        rewrite (chain_one _ _ _ _ C' D) in N'. now inversion N'. }
      enough (moves_left g (d :: c :: l) < moves_left g (c :: l)) by lia. apply Ants.sum_lt.
      + intros x; unfold moves_for. destruct (cell_dec x d) as [->|Q].
        * rewrite first_among, (not_among _ d X), E; lia.
        * cbn [existsb]. destruct (same x d) eqn:S; [apply same_spec in S; contradiction|]. cbn [orb]; lia.
      + exists d; split; [apply I; congruence|]. unfold moves_for.
        rewrite first_among, (not_among _ d X), E; lia.
    - destruct l as [|p l]; cbn in C; [unfold parent in C; rewrite E in C; discriminate|].
      destruct C as [Cp C]. assert (p = d) as -> by (unfold parent in Cp; rewrite E in Cp; congruence).
      exists l; split; [exact C|].
      assert (~ In c (d :: l)) as X by now inversion N.
      enough (moves_left g (d :: l) < moves_left g (c :: d :: l)) by lia. apply Ants.sum_lt.
      + intros x; unfold moves_for. destruct (existsb (same x) (d :: l)) eqn:S.
        * apply is_among in S; rewrite (proj2 (is_among (c :: d :: l) x) (or_intror S)); lia.
        * destruct (existsb (same x) (c :: d :: l)) eqn:T; [|lia]. apply is_among in T; destruct T as [<-|T];
            [rewrite E; lia | apply is_among in T; congruence].
      + exists c; split; [apply I; congruence|]. unfold moves_for.
        rewrite first_among, (not_among _ c X), E; lia.
  Qed.

  Lemma run_one : forall n f used w past, run n f used w past -> length used <= 1 -> good f used
    /\ forall i, i < n -> match w i with
       | Some c => held f c (moves_of i past)
       | None => moves_of i past <= 2 * length cells
       end.
  Proof.
    intros n f used w past R; induction R as [f w F I A | f used w past i c g used' next R IH L E A]; intros O.
    { assert (forall c, parent f c = None) as P by (intros c; unfold parent; now destruct (F c) as [->|[->| ->]]).
      split; [split; [exact I | intros c l q E; destruct (F c) as [X|[X|X]]; congruence |]|].
      - intros c X; now rewrite P in X.
      - intros i L; destruct (A i L) as [c [-> X]]; now left. }
    assert (length used <= length used') as U by (destruct A as [|? ? ? ? ? J]; [lia | destruct J; cbn; lia]).
    destruct (IH ltac:(lia)) as [G H]. destruct (act_one _ _ _ _ _ _ G O A) as [K [G' [P D]]].
    split; [exact G'|]. intros j J; specialize (H j J). unfold put, moves_of; cbn [filter fst snd].
    destruct (Nat.eqb_spec j i) as [->|Q].
    - rewrite Nat.eqb_refl. rewrite E in H. apply (held_keeps f g used') in H; auto. cbn [andb]. destruct next as [d|].
      + cbn [length]. now apply (goes_held g used' c).
      + destruct H as [[X _]|[l [_ B]]]; [unfold parent in P; rewrite X in P; contradiction|].
        unfold moves_of in B; lia.
    - rewrite (proj2 (Nat.eqb_neq i j)) by congruence. cbn [andb]. destruct (w j) as [x|]; [|exact H].
      now apply (held_keeps f g used').
  Qed.
End Team.

(** As long as there has been one tree at most, every helper makes at most two moves a cell. *)
Theorem BRICKS_10 : forall (cell : Type) (same : cell -> cell -> bool) beside cells,
  (forall a b, same a b = true <-> a = b) ->
  forall n f used w past, run cell beside cells n f used w past -> length used <= 1 ->
  forall i, i < n -> moves_of cell i past <= 2 * length cells.
Proof.
  intros cell same beside cells E n f used w past R O i L.
  destruct (run_one cell same beside cells E n f used w past R O) as [G H]. specialize (H i L).
  destruct (w i) as [c|]; [|exact H]. destruct H as [[_ ->]|[l [_ B]]]; lia.
Qed.
