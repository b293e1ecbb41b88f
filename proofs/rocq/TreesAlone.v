(** A helper alone, by the table of the rule: BRICKS-12, on every finite floor. TreesTie.v compares the kernel. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Trees.
From Tautline Require Ants.
Import ListNotations.

Section Helpers.
  Variables (cell : Type) (same : cell -> cell -> bool) (beside : cell -> cell -> Prop) (cells : list cell).
  Notation floor := (Trees.floor cell).
  Notation Wall := (Trees.Wall cell). Notation Open := (Trees.Open cell). Notation Visited := (Trees.Visited cell).
  Notation Unexplored := (Trees.Unexplored cell). Notation Explored := (Trees.Explored cell).

  (** Nothing beside a cell is so. *)
  Definition none (f : floor) (c : cell) (P : note cell -> Prop) : Prop := forall d, beside c d -> ~ P (f d).
  Definition of_tree (P : nat -> Prop) (n : note cell) : Prop := exists l q, n = Open l q /\ P l.
  Definition child_of (c : cell) (n : note cell) : Prop := exists l, n = Open l (Some c).

  (** The agent's cell is of the tree [m]: it is already, it joins one beside it, or it founds one. *)
  Inductive joined (f : floor) (used : list nat) (c : cell) : floor -> list nat -> nat -> Prop :=
  | of_one : forall m q, f c = Open m q -> joined f used c f used m
  | beside_one : forall p m q g, f c = Explored -> beside c p -> f p = Open m q -> none f c (of_tree (lt m)) ->
      becomes cell f c (Open m (Some p)) g -> joined f used c g used m
  | of_its_own : forall m g, f c = Explored -> none f c (of_tree (fun _ => True)) -> ~ In m used ->
      becomes cell f c (Open m None) g -> joined f used c g (m :: used) m.

  (** What it does then: it explores a cell; else adopts an explored one; else one of a lower label; else it goes to a
      child; else to a greater label; else its cell is visited, and it goes to the parent, or is done. *)
  Inductive helps (f : floor) (c : cell) (m : nat) : floor -> option cell -> Prop :=
  | explores : forall d g, beside c d -> f d = Unexplored -> becomes cell f d (Open m (Some c)) g ->
      helps f c m g (Some d)
  | adopts : forall d g, none f c (eq Unexplored) -> beside c d ->
      f d = Explored \/ none f c (eq Explored) /\ of_tree (gt m) (f d) -> becomes cell f d (Open m (Some c)) g ->
      helps f c m g (Some d)
  | goes_down : forall d, none f c (eq Unexplored) -> none f c (eq Explored) -> none f c (of_tree (gt m)) ->
      beside c d ->
      child_of c (f d) -> helps f c m f (Some d)
  | goes_over : forall d, none f c (eq Unexplored) -> none f c (eq Explored) -> none f c (of_tree (gt m)) ->
      none f c (child_of c) -> beside c d -> of_tree (lt m) (f d) -> helps f c m f (Some d)
  | is_finished : forall q g, none f c (eq Unexplored) -> none f c (eq Explored) -> none f c (of_tree (gt m)) ->
      none f c (child_of c) -> none f c (of_tree (lt m)) -> f c = Open m q -> becomes cell f c (Visited q) g ->
      helps f c m g q.

  (** From a visited cell it goes to where more was left, or is done. *)
  Inductive act (f : floor) (used : list nat) (c : cell) : floor -> list nat -> option cell -> Prop :=
  | is_visited : forall e, f c = Visited e -> act f used c f used e
  | is_not : forall g used' m h next, joined f used c g used' m -> helps g c m h next -> act f used c h used' next.

  (** An agent alone, from one cell of an unexplored floor: the floor, the labels, where it is, and how many turns. *)
  Inductive alone : floor -> list nat -> option cell -> nat -> Prop :=
  | sets_out : forall f s, (forall c, f c <> Wall -> In c cells) -> f s = Explored ->
      (forall c, c <> s -> f c = Wall \/ f c = Unexplored) -> alone f [] (Some s) 0
  | acts_on : forall f used c g used' next k, alone f used (Some c) k -> act f used c g used' next ->
      alone g used' next (S k).

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.

  (** The cells of the tree, from that of the agent up to the root. *)
  Fixpoint chain (f : floor) (m : nat) (l : list cell) : Prop :=
    match l with
    | [] => True
    | [c] => f c = Open m None
    | c :: (p :: _) as up => f c = Open m (Some p) /\ chain f m up
    end.
  Record climbs (f : floor) (m : nat) (l : list cell) : Prop := {
    chained : chain f m l;
    unlike : NoDup l;
    no_other : forall c n q, f c = Open n q -> In c l;
    none_explored : forall c, f c <> Explored;
  }.

  Lemma cell_dec : forall a b : cell, a = b \/ a <> b.
  Proof.
    intros a b; destruct (same a b) eqn:E; [left; now apply same_spec|]. right; intros ->.
    rewrite (proj2 (same_spec b b) eq_refl) in E; discriminate.
  Qed.
  Lemma chain_same : forall f g m l, (forall c, In c l -> g c = f c) -> chain f m l -> chain g m l.
  Proof.
    intros f g m l; induction l as [|c [|p l] IH]; intros E H; cbn in *; [exact I | now rewrite E by auto|].
    destruct H as [H T]; split; [now rewrite E by auto|]. apply IH; auto.
  Qed.
  Lemma chain_open : forall f m l c, chain f m l -> In c l -> exists q, f c = Open m q /\ forall p, q = Some p ->
    In p (tl l).
  Proof.
    intros f m l; induction l as [|c [|p l] IH]; intros d H I; [destruct I | destruct I as [<-|[]] |].
    - exists None; split; [exact H | discriminate].
    - destruct H as [H T]; destruct I as [<-|I].
      + exists (Some p); split; [exact H|]. intros p' E; injection E as <-; now left.
      + destruct (IH d T I) as [q [F P]]. exists q; split; [exact F|]. intros p' E; right; now apply P.
  Qed.

  (** How many turns are left: two for an unexplored cell, one for each other that is not visited. *)
  Definition turns_for (n : note cell) : nat :=
    match n with Trees.Unexplored _ => 2 | Trees.Wall _ | Trees.Visited _ _ => 0 | _ => 1 end.
  Definition turns_left (f : floor) : nat := Ants.sum cell cells (fun c => turns_for (f c)).
  Definition inside (f : floor) : Prop := forall c, f c <> Wall -> In c cells.

  Lemma changed : forall f g c n, inside f -> becomes cell f c n g -> f c <> Wall ->
    inside g /\ (turns_for n <= turns_for (f c) -> turns_left g <= turns_left f)
    /\ (turns_for n < turns_for (f c) -> turns_left g < turns_left f).
  Proof.
    intros f g c n I [Gc Go] W. assert (forall d, d = c \/ g d = f d) as D.
    { intros d; destruct (cell_dec d c); auto. }
    assert (forall d, turns_for n <= turns_for (f c) -> turns_for (g d) <= turns_for (f d)) as L
      by (intros d L; destruct (D d) as [->|E]; [now rewrite Gc | now rewrite E]).
    split; [intros d X; apply I; destruct (D d) as [->|E]; [exact W | now rewrite <- E]|]. split; intros H.
    - apply Ants.sum_le; auto.
    - apply Ants.sum_lt; [intros d; apply L; lia|]. exists c; split; [now apply I | now rewrite Gc].
  Qed.

  Lemma helps_climbs : forall f c l m g next, inside f -> climbs f m (c :: l) -> helps f c m g next ->
    turns_left g < turns_left f /\ inside g
    /\ match next with None => True | Some d => exists l', climbs g m (d :: l') end.
  Proof.
    intros f c l m g next I [C U O X] H. assert (forall d n q, f d = Open n q -> n = m /\ q <> Some c) as ONE.
    { intros d n q F; destruct (chain_open f m _ d C (O d n q F)) as [r [F' P]]. rewrite F in F'; injection F' as -> ->.
      split; [reflexivity|]. intros ->. inversion U; subst; cbn in P; auto. }
    destruct (chain_open f m _ c C (or_introl eq_refl)) as [r [Fc _]].
    destruct H as [d g B F G | d g N B F G | d N N' L B [n F] | d N N' L H B [n [q [F K]]] | q g N N' L H H' F G].
    - destruct (changed f g d _ I G ltac:(congruence)) as [I' [_ T]]; rewrite F in T.
      split; [apply T; cbn; lia | split; [exact I'|]]. destruct G as [Gd Go]. assert (~ In d (c :: l)) as D.
      { intros J; destruct (chain_open f m _ d C J) as [q [F' _]]; congruence. }
      exists (c :: l); split.
      + split; [exact Gd|]. apply (chain_same f); [|exact C]. intros e J; apply Go; intros ->; contradiction.
      + now constructor.
      + intros e n q E. destruct (cell_dec e d) as [->|Q]; [now left|]. rewrite (Go e Q) in E; right; eauto.
      + intros e E. destruct (cell_dec e d) as [->|Q]; [congruence|]. rewrite (Go e Q) in E; now apply (X e).
    - exfalso; destruct F as [F|[_ [n [q [F L]]]]]; [now apply (X d)|]. destruct (ONE d n q F); lia.
    - exfalso; now destruct (ONE d n _ F).
    - exfalso; destruct (ONE d n q F); lia.
    - destruct (changed f g c _ I G ltac:(congruence)) as [I' [_ T]]; rewrite F in T.
      split; [apply T; cbn; lia | split; [exact I'|]]. destruct G as [Gc Go]. inversion U as [|? ? NI ND]; subst.
      destruct l as [|p l]; cbn in C; [rewrite F in C; injection C as ->; exact Logic.I|].
      destruct C as [C C']; rewrite F in C; injection C as ->. exists l; split.
      + apply (chain_same f); [|exact C']. intros e J; apply Go; intros ->; contradiction.
      + exact ND.
      + intros e n q E. destruct (cell_dec e c) as [->|Q]; [congruence|]. rewrite (Go e Q) in E.
        destruct (O e n q E) as [J|J]; [congruence | exact J].
      + intros e E. destruct (cell_dec e c) as [->|Q]; [congruence|]. rewrite (Go e Q) in E; now apply (X e).
  Qed.

  Lemma alone_climbs : forall f used at_ k, alone f used at_ k ->
    inside f /\ k + turns_left f <= 2 * length cells
    /\ match at_ with
       | None => True
       | Some c => (exists m l, climbs f m (c :: l))
           \/ f c = Explored /\ forall d, d <> c -> f d = Wall \/ f d = Unexplored
       end.
  Proof.
    intros f used at_ k A; induction A as [f s I F O | f used c g used' next k A [I [B S]] H].
    { split; [exact I|]. split; [|right; auto]. rewrite Nat.mul_comm; cbn [Nat.add]. apply Ants.sum_most.
      intros d _; destruct (f d); cbn; lia. }
    destruct H as [e F | g used' m h next J H].
    { exfalso; destruct S as [[m [l [C _ _ _]]]|[E _]]; [|congruence].
      destruct (chain_open f m _ c C (or_introl eq_refl)) as [q [F' _]]; congruence. }
    assert (inside g /\ turns_left g <= turns_left f /\ exists l, climbs g m (c :: l)) as [I' [T [l C]]].
    { destruct S as [[n [l [C U O X]]]|[E S]].
      - destruct (chain_open f n _ c C (or_introl eq_refl)) as [q [F _]].
        destruct J as [m q' F' | p m q' g F' _ _ _ _ | m g F' _ _ _]; [|congruence|congruence].
        rewrite F in F'; injection F' as <- <-. split; [exact I|]. split; [lia|]. exists l; now split.
      - destruct J as [m q' F' | p m q' g F' _ P _ _ | m g F' _ _ G]; [congruence | |].
        + exfalso. destruct (cell_dec p c) as [->|Q]; [congruence|]. destruct (S p Q); congruence.
        + destruct (changed f g c _ I G ltac:(congruence)) as [I' [T _]]; rewrite E in T.
          split; [exact I'|]. split; [apply T; cbn; lia|]. destruct G as [Gc Go]. exists []; split.
          * exact Gc.
          * repeat constructor; intros [].
          * intros d n q D; destruct (cell_dec d c) as [->|Q]; [now left|]. rewrite (Go d Q) in D.
            destruct (S d Q); congruence.
          * intros d D; destruct (cell_dec d c) as [->|Q]; [congruence|]. rewrite (Go d Q) in D.
            destruct (S d Q); congruence. }
    destruct (helps_climbs _ _ _ _ _ _ I' C H) as [L [I'' N]]. split; [exact I''|]. split; [lia|].
    destruct next as [d|]; [left; eauto | exact Logic.I].
  Qed.
End Helpers.

(** A helper alone has at most two turns a cell, and in each it makes one move at most. *)
Theorem BRICKS_12 : forall (cell : Type) (same : cell -> cell -> bool) beside cells,
  (forall a b, same a b = true <-> a = b) ->
  forall f used at_ k, alone cell beside cells f used at_ k -> k <= 2 * length cells.
Proof.
  intros cell same beside cells E f used at_ k A.
  destruct (alone_climbs cell same beside cells E f used at_ k A) as [_ [B _]]; lia.
Qed.
