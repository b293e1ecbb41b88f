(** The tie between the kernel and Trees.v: the kernel's runs in generated/TreesAnswers.v,
  of brick-tree and of helpers, are
    runs of Trees.v, action by action; and whenever an agent is done, its cell is visited and stores no side. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Trees.
From Tautline Require Marking.
From Tautline.generated Require Import TreesAnswers.
Import ListNotations.

Definition is_in (l : list cell) (c : cell) : bool := existsb (cell_eqb c) l.
Lemma is_in_spec : forall l c, is_in l c = true <-> In c l.
Proof.
  intros l c; unfold is_in; rewrite existsb_exists; split; [intros [x [I E]]; apply cell_eqb_spec in E; now subst|].
  intros I; exists c; split; [exact I | now apply cell_eqb_spec].
Qed.

(** What a sensor says: 0 to 3 for its state, the label, the side and 1, or 0 for none. *)
Definition note_of (c : cell) (said : nat * nat * nat) : note cell :=
  let '(state, label, s) := said in
  let q := match s with O => None | S s => Some (beyond c (nth s all_sides East)) end in
  match state with 0 => Unexplored cell | 1 => Explored cell | 2 => Open cell label q | _ => Visited cell q end.

Section Replay.
  Variable walls : list edge.

  Definition sides_of (c : cell) : list cell :=
    map (beyond c) (filter (fun s => negb (existsb (edge_eqb (edge_of c s)) walls)) all_sides).
  Definition beside (a b : cell) : Prop := In b (sides_of a).
  Notation floor := (floor cell).
  Definition put (f : floor) (c : cell) (n : note cell) : floor := fun d => if cell_eqb d c then n else f d.
  Definition is_accessible (f : floor) (c : cell) : bool := match f c with Wall _ | Visited _ _ => false |
    _ => true end.

  (** The accessible cells that are joined with those of [l], as far as [n] times one more. *)
  Definition grow (l : list cell) (c : cell) : list cell := if is_in l c then l else c :: l.
  Fixpoint spread (ok : cell -> bool) (n : nat) (l : list cell) : list cell :=
    match n with O => l | S n => spread ok n (fold_left grow (filter ok (flat_map sides_of l)) l) end.
  Definition enough : nat := 20.
  Definition all_joined (ok : cell -> bool) (l : list cell) : bool :=
    forallb (is_in (spread ok enough (firstn 1 l))) l.

  Definition own_label (f : floor) (c : cell) : option nat := match f c with Open _ m _ => Some m | _ => None end.
  Definition may_be_marked (f : floor) (c : cell) : bool :=
    forallb (fun d => match f d with
      | Open _ l q => match q with Some p => negb (cell_eqb p c) | None => true end
          && match own_label f c with Some m => l =? m | None => true end
      | _ => true
      end) (sides_of c).

  (** What an action has made of one sensor, and the labels given. *)
  Definition joins_to (f : floor) (c p : cell) (m : nat) : bool :=
    is_in (sides_of c) p && match own_label f p with Some l => l =? m | None => false end.
  Definition leaf (f : floor) (c : cell) : bool :=
    may_be_marked f c
    && forallb (fun d => negb (is_accessible f d) || match own_label f d with Some _ => true |
      None => false end) (sides_of c).
  Definition brick (f : floor) (c : cell) (exit : option cell) : bool :=
    let near := filter (is_accessible f) (sides_of c) in
    is_accessible f c && may_be_marked f c && all_joined (fun d => is_accessible f d && negb (cell_eqb d c)) near
    && match exit with Some e => is_in near e | None => match near with [] => true | _ => false end end.
  Definition same_exit (q e : option cell) : bool :=
    match q, e with Some a, Some b => cell_eqb a b | None, None => true | _, _ => false end.

  Definition step (fu : floor * list nat) (change : cell * (nat * nat * nat)) : option (floor * list nat) :=
    let '(f, used) := fu in
    let c := fst change in
    let n := note_of c (snd change) in
    let now := (put f c n, used) in
    match f c, n with
    | Unexplored _, Explored _ => Some now
    | Unexplored _, Open _ m (Some p) => if joins_to (put f c (Explored cell)) c p m then Some now else None
    | Explored _, Open _ m (Some p) => if joins_to f c p m then Some now else None
    | Explored _, Open _ m None => if existsb (Nat.eqb m) used then None else Some (put f c n, m :: used)
    | Open _ l _, Open _ m (Some p) => if joins_to f c p m && (l <? m) then Some now else None
    | Explored _, Visited _ e => if brick f c e then Some now else
        match e with
        | Some p => match own_label f p with
          | Some m => if joins_to f c p m && leaf (put f c (Open cell m e)) c then Some now else None
          | None => None
          end
        | None => None
        end
    | Open _ m q, Visited _ e => if brick f c e || leaf f c && same_exit q e then Some now else None
    | _, _ => None
    end.

  Fixpoint steps (fu : floor * list nat) (changes : list (cell * (nat * nat * nat))) : option (floor * list nat) :=
    match changes with
    | [] => Some fu
    | change :: changes => match step fu change with Some next => steps next changes | None => None end
    end.

  Definition action : Type := cell * list (cell * (nat * nat * nat)) * bool.
  Fixpoint replay (fu : floor * list nat) (actions : list action) : option (floor * list nat) :=
    match actions with
    | [] => Some fu
    | (here, changes, done) :: actions =>
        match steps fu changes with
        | Some next =>
            if negb done || match fst next here with Visited _ None => true | _ => false end
            then replay next actions else None
        | None => None
        end
    end.

  Definition start_floor (cells starts : list cell) : floor :=
    fun c => if is_in cells c then if is_in starts c then Explored cell else Unexplored cell else Wall cell.
  Definition is_run (cells starts : list cell) (actions : list action) : bool :=
    all_joined (is_in cells) cells
    && match replay (start_floor cells starts, []) actions with Some _ => true | None => false end.

  (** All that is so checked is a run. *)
  Lemma put_becomes : forall f c n, becomes cell f c n (put f c n).
  Proof.
    intros f c n; split; unfold put; [now rewrite (proj2 (cell_eqb_spec c c) eq_refl)|].
    intros d D; destruct (cell_eqb d c) eqn:E; [apply cell_eqb_spec in E; contradiction | reflexivity].
  Qed.

  Lemma put_twice : forall f c n m, becomes cell (put f c n) c m (put f c m).
  Proof.
    intros f c n m; split; [now apply put_becomes|]. intros d D. destruct (put_becomes f c n) as [_ A],
      (put_becomes f c m)
      as [_ B]. now rewrite A, B.
  Qed.

  Lemma beside_sym : forall a b, beside a b -> beside b a.
  Proof.
    intros a b I; apply in_map_iff in I; destruct I as [s [<- I]]; apply filter_In in I; destruct I as [_ W].
    apply in_map_iff; exists (opposite s); split; [apply (after_reverse a (Cross s))|].
    apply filter_In; split; [destruct s; cbn; auto|]. now rewrite edge_of_opposite.
  Qed.

  Lemma beside_other : forall a b, beside a b -> a <> b.
  Proof.
    intros a b I E; apply in_map_iff in I; destruct I as [s [H _]]. apply (after_cross a s); cbn; congruence.
  Qed.

  Lemma way_back : forall free a b, Marking.way cell beside free a b -> Marking.way cell beside free b a.
  Proof.
    intros free a b W; induction W as [a F | a b c F B W IH]; [now constructor|].
    eapply Marking.way_trans; [exact IH|]. eapply Marking.onward; [|apply beside_sym; exact B | now constructor].
    destruct W; auto.
  Qed.

  Section Spread.
    Variables (ok : cell -> bool) (free : cell -> Prop) (x : cell).
    Hypothesis OK : forall c, ok c = true <-> free c.
    Definition found (near : list cell) : Prop := forall c, In c near -> Marking.way cell beside free x c.

    Lemma grow_found : forall more near, found near -> found more -> found (fold_left grow more near).
    Proof.
      induction more as [|y more IH]; intros near F M; cbn [fold_left]; [exact F|].
      apply IH; [|intros c I; apply M; now right]. intros c I; unfold grow in I.
      destruct (is_in near y); [auto|]. destruct I as [<-|I]; [apply M; now left | auto].
    Qed.

    Lemma spread_found : forall n near, found near -> found (spread ok n near).
    Proof.
      induction n as [|n IH]; intros near F; cbn [spread]; [exact F|].
      apply IH, grow_found; [exact F|]. intros c I; apply filter_In in I; destruct I as [I O].
      apply in_flat_map in I; destruct I as [y [Y I]]. pose proof (F y Y) as W.
      apply (Marking.way_trans cell beside free x y c W).
      apply (Marking.onward cell beside free y c c); [clear - W; induction W; auto | exact I|].
      apply Marking.here, OK, O.
    Qed.
  End Spread.

  Lemma all_joined_ways : forall (ok : cell -> bool) (free : cell -> Prop) l, (forall c, ok c = true <-> free c) ->
    (forall c, In c l -> free c) -> all_joined ok l = true -> forall a b, In a l -> In b l ->
    Marking.way cell beside free a b.
  Proof.
    intros ok free l OK F J a b A B. unfold all_joined in J; rewrite forallb_forall in J.
    remember (spread ok enough (firstn 1 l)) as near eqn:E. destruct l as [|x l]; [destruct A|].
    change (firstn 1 (x :: l)) with [x] in E.
    assert (found free x [x]) as X by (intros d [<-|[]]; apply Marking.here, F; now left).
    pose proof (spread_found ok free x OK enough [x] X) as S. rewrite <- E in S.
    assert (forall c, In c (x :: l) -> Marking.way cell beside free x c) as W
      by (intros c I; exact (S c (proj1 (is_in_spec _ _) (J c I)))).
    exact (Marking.way_trans cell beside free a x b (way_back free x a (W a A)) (W b B)).
  Qed.

  Lemma accessible_spec : forall f c, is_accessible f c = true <-> accessible cell f c.
  Proof. intros f c; unfold is_accessible, accessible; destruct (f c); split; auto; discriminate || contradiction. Qed.

  Lemma may_spec : forall f c, may_be_marked f c = true -> may_mark cell beside f c.
  Proof.
    intros f c M; unfold may_be_marked in M; rewrite forallb_forall in M; split.
    - intros d l B E; specialize (M d B); rewrite E in M. rewrite (proj2 (cell_eqb_spec c c) eq_refl) in M;
      discriminate.
    - intros m q d l r E B F; specialize (M d B). rewrite F in M; unfold own_label in M; rewrite E in M.
      apply andb_true_iff in M; now apply Nat.eqb_eq.
  Qed.

  Lemma joins_spec : forall f c p m, joins_to f c p m = true -> beside c p /\ exists q, f p = Open cell m q.
  Proof.
    intros f c p m J; apply andb_true_iff in J; destruct J as [I J]; split; [now apply is_in_spec|].
    unfold own_label in J; destruct (f p) as [| | |l q|]; try discriminate. apply Nat.eqb_eq in J; subst; eauto.
  Qed.

  Lemma leaf_spec : forall f c, leaf f c = true -> may_mark cell beside f c
    /\ forall d, beside c d -> accessible cell f d -> is_open cell f d.
  Proof.
    intros f c L; apply andb_true_iff in L; destruct L as [M L]; split; [now apply may_spec|].
    rewrite forallb_forall in L; intros d B A; specialize (L d B). apply accessible_spec in A; rewrite A in L.
    unfold own_label in L; unfold is_open; destruct (f d); try discriminate; eauto.
  Qed.

  Lemma brick_run : forall f used c e, run cell beside f used -> brick f c e = true ->
    run cell beside (put f c (Visited cell e)) used.
  Proof.
    intros f used c e R B; unfold brick in B; rewrite !andb_true_iff in B; destruct B as [[[A M] J] X].
    eapply goes_on; [exact R|]. apply marks_brick with (c := c) (exit := e);
      [now apply accessible_spec | now apply may_spec | | | apply put_becomes].
    - intros a b Fa Fb Ba Bb. eapply all_joined_ways; [| | exact J | |].
      + intros d; unfold Marking.unmarked; rewrite andb_true_iff, accessible_spec, negb_true_iff.
        split; intros [P Q]; split; auto.
        * intros ->; rewrite (proj2 (cell_eqb_spec c c) eq_refl) in Q; discriminate.
        * destruct (cell_eqb d c) eqn:E; [apply cell_eqb_spec in E; contradiction | reflexivity].
      + intros d I; apply filter_In in I; destruct I as [I K]; split; [now apply accessible_spec|].
        intros ->; now apply (beside_other c c).
      + apply filter_In; split; [now apply beside_sym | apply accessible_spec, Fa].
      + apply filter_In; split; [exact Bb | apply accessible_spec, Fb].
    - destruct e as [e|].
      + apply is_in_spec, filter_In in X; destruct X as [X Y]; split; [exact X | now apply accessible_spec].
      + intros d I N; apply accessible_spec in N. destruct (filter (is_accessible f) (sides_of c)) eqn:E;
        [|discriminate].
        assert (In d []) as []. rewrite <- E; now apply filter_In.
  Qed.

  Lemma step_run : forall f used change g used', run cell beside f used -> step (f, used) change = Some (g, used') ->
    run cell beside g used'.
  Proof.
    intros f used [c said] g used' R E; unfold step in E; cbn [fst snd] in E.
    destruct (f c) as [| | |l r|] eqn:F; [discriminate | | | | discriminate];
      destruct (note_of c said) as [| | |m [p|]|e] eqn:N; try discriminate.
    - injection E as <- <-; eapply goes_on; [exact R|]. eapply enters; [exact F | apply put_becomes].
    - destruct (joins_to _ c p m) eqn:J; [|discriminate]; injection E as <- <-.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. eapply goes_on.
      + eapply goes_on; [exact R|]. eapply enters; [exact F | apply put_becomes].
      + eapply joins; [apply put_becomes | exact B | exact P | apply put_twice].
    - destruct (joins_to f c p m) eqn:J; [|discriminate]; injection E as <- <-.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. eapply goes_on; [exact R|].
      eapply joins; [exact F | exact B | exact P | apply put_becomes].
    - destruct (existsb (Nat.eqb m) used) eqn:U; [discriminate|]; injection E as <- <-.
      eapply goes_on; [exact R|]. eapply founds; [exact F | | apply put_becomes].
      intros I; assert (existsb (Nat.eqb m) used = true); [|congruence]. apply existsb_exists; exists m.
      split; [exact I | apply Nat.eqb_refl].
    - destruct (brick f c e) eqn:B; [injection E as <- <-; now apply brick_run|].
      destruct e as [p|]; [|discriminate]. destruct (own_label f p) as [m|]; [|discriminate].
      destruct (joins_to f c p m && leaf _ c) eqn:J; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in J; destruct J as [J L]. destruct (joins_spec _ _ _ _ J) as [B' [q P]].
      destruct (leaf_spec _ _ L) as [M O]. eapply goes_on.
      + eapply goes_on; [exact R|]. eapply joins; [exact F | exact B' | exact P | apply put_becomes].
      + eapply marks_leaf; [apply put_becomes | exact M | exact O | apply put_twice].
    - destruct (joins_to f c p m && _) eqn:J; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in J; destruct J as [J L]; apply Nat.ltb_lt in L.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. eapply goes_on; [exact R|].
      eapply adopted; [exact F | exact B | exact P | exact L | apply put_becomes].
    - destruct (brick f c e) eqn:B; [injection E as <- <-; now apply brick_run|]. cbn [orb] in E.
      destruct (leaf f c && same_exit r e) eqn:L; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in L; destruct L as [L X]. destruct (leaf_spec _ _ L) as [M O].
      assert (r = e) as -> by (destruct r, e; try discriminate; [apply cell_eqb_spec in X; now subst | reflexivity]).
      eapply goes_on; [exact R|]. eapply marks_leaf; [exact F | exact M | exact O | apply put_becomes].
  Qed.

  Lemma replay_run : forall actions f used g used', run cell beside f used ->
    replay (f, used) actions = Some (g, used') -> run cell beside g used'.
  Proof.
    assert (forall changes f used g used', run cell beside f used -> steps (f, used) changes = Some (g, used') ->
      run cell beside g used') as S.
    { induction changes as [|change changes IH]; intros f used g used' R E; cbn [steps] in E;
      [now injection E as <- <-|].
      destruct (step _ _) as [[h u]|] eqn:X; [|discriminate]. eapply IH; [|exact E]. eapply step_run; eauto. }
    induction actions as [|[[here changes] done] actions IH]; intros f used g used' R E; cbn [replay] in E;
      [now injection E as <- <-|].
    destruct (steps _ _) as [[h u]|] eqn:X; [|discriminate]. destruct (_ || _); [|discriminate].
    eapply IH; [|exact E]. eapply S; eauto.
  Qed.
End Replay.

Definition recorded : Type := list cell * list edge * list cell * list action.
Definition recorded_runs : list (list recorded) := [runs_tree; runs_helpers].

Lemma all_recorded : forallb (forallb (fun r : recorded =>
  let '(cells, walls, first, actions) := r in is_run walls cells first actions)) recorded_runs = true.
Proof. vm_compute; reflexivity. Qed.

(** Every run of the kernel is one of Trees.v, action by action. *)
Theorem kernel_trees_run : forall rs cells walls starts actions, In rs recorded_runs ->
  In (cells, walls, starts, actions) rs ->
  exists f used, replay walls (start_floor cells starts, []) actions = Some (f, used) /\ run cell (beside walls) f used.
Proof.
  intros rs cells walls starts actions I J; pose proof all_recorded as A.
  rewrite forallb_forall in A; specialize (A _ I); rewrite forallb_forall in A; specialize (A _ J).
  cbn beta iota in A. apply andb_true_iff in A; destruct A as [C A].
  destruct (replay _ _ _) as [[f used]|] eqn:E; [|discriminate]. exists f, used; split; [reflexivity|].
  eapply replay_run; [|exact E]. apply Trees.starts.
  - intros c; unfold start_floor; destruct (is_in cells c); [destruct (is_in starts c)|]; auto.
  - assert (forall c, is_in cells c = true <-> accessible cell (start_floor cells starts) c) as OK.
    { intros c; unfold accessible, start_floor; destruct (is_in cells c); [destruct (is_in starts c)|]; split; auto;
        discriminate || contradiction. }
    intros a b Fa Fb; eapply all_joined_ways; [exact OK | | exact C | |]; try (now apply is_in_spec, OK).
    intros c I0; now apply OK, is_in_spec.
Qed.
