(** The tie between the kernel, Trees.v and TreesEnd.v: the kernel's runs in generated/TreesAnswers.v, of brick-tree, of
    helpers and of careful ones that miss sensors, are runs of TreesEnd.v, turn by turn. Two more runs refute BRICKS-10
    and BRICKS-12 of brick-tree. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Trees.
From Tautline Require Marking TreesEnd.
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

  (** A turn: whose, whether a sensor is missed, the side and 1 through which the agent goes,
      5 if it stays and 0 if it is
      done, its cell, and what is written. *)
  Definition action : Type := nat * bool * nat * cell * list (cell * (nat * nat * nat)).
  Definition goes (here : cell) (way : nat) : option cell :=
    match way with 0 => None | 5 => Some here | S s => Some (beyond here (nth s all_sides East)) end.
  Definition walk (f : floor) (c d : cell) : bool :=
    match f c, f d with
    | Open _ m _, Open _ l r => (l =? m) && same_exit r (Some c) || (m <? l)
    | Visited _ e, _ => is_accessible f d || same_exit e (Some d)
    | _, _ => false
    end.
  Definition is_last (f : floor) (c : cell) : bool := match f c with Visited _ None => true | _ => false end.

  Definition state : Type := floor * list nat * (nat -> TreesEnd.place cell) * TreesEnd.history cell.
  Definition take (n : nat) (s : state) (a : action) : option state :=
    let '(f, used, w, past) := s in
    let '(i, missed, way, here, changes) := a in
    let next := goes here way in
    let now g used' p := Some (g, used', TreesEnd.put cell w i p, (i, missed, next) :: past) in
    match w i with
    | Some (c, may) =>
        if (i <? n) && cell_eqb c here then
          match changes, next with
          | [], Some d => if walk f c d || (may || missed) then now f used (Some (d, missed)) else None
          | [], None => if is_last f c then now f used None else None
          | _, _ =>
              match steps (f, used) changes, next with
              | Some (g, used'), Some d => now g used' (Some (d, true))
              | Some (g, used'), None => if is_last g c then now g used' None else None
              | None, _ => None
              end
          end
        else None
    | None => None
    end.
  Fixpoint replay (n : nat) (s : state) (actions : list action) : option state :=
    match actions with
    | [] => Some s
    | a :: actions => match take n s a with Some next => replay n next actions | None => None end
    end.

  Definition start_floor (cells starts : list cell) : floor :=
    fun c => if is_in cells c then if is_in starts c then Explored cell else Unexplored cell else Wall cell.
  Definition start (cells starts : list cell) : state :=
    (start_floor cells starts, [], fun i => Some (nth i starts (0, 0)%Z, false), []).
  Definition ends_with (ok : state -> bool) (cells starts : list cell) (actions : list action) : bool :=
    all_joined (is_in cells) cells
    && match replay (length starts) (start cells starts) actions with Some s => ok s | None => false end.

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

  Lemma same_exit_spec : forall q e, same_exit q e = true -> q = e.
  Proof. intros [a|] [b|] S; try discriminate; [apply cell_eqb_spec in S; now subst | reflexivity]. Qed.

  Lemma leaf_spec : forall f c, leaf f c = true -> may_mark cell beside f c
    /\ forall d, beside c d -> accessible cell f d -> is_open cell f d.
  Proof.
    intros f c L; apply andb_true_iff in L; destruct L as [M L]; split; [now apply may_spec|].
    rewrite forallb_forall in L; intros d B A; specialize (L d B). apply accessible_spec in A; rewrite A in L.
    unfold own_label in L; unfold is_open; destruct (f d); try discriminate; eauto.
  Qed.

  Lemma brick_acts : forall f used c e, brick f c e = true ->
    acts cell beside f used (put f c (Visited cell e)) used.
  Proof.
    intros f used c e B; unfold brick in B; rewrite !andb_true_iff in B; destruct B as [[[A M] J] X].
    apply marks_brick with (c := c) (exit := e);
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

  Lemma step_writes : forall f used change g used', step (f, used) change = Some (g, used') ->
    TreesEnd.writes cell beside f used g used'.
  Proof.
    intros f used [c said] g used' E; unfold step in E; cbn [fst snd] in E.
    destruct (f c) as [| | |l r|] eqn:F; [discriminate | | | | discriminate];
      destruct (note_of c said) as [| | |m [p|]|e] eqn:N; try discriminate.
    - injection E as <- <-; apply TreesEnd.once. eapply enters; [exact F | apply put_becomes].
    - destruct (joins_to _ c p m) eqn:J; [|discriminate]; injection E as <- <-.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. eapply TreesEnd.again.
      + apply TreesEnd.once. eapply enters; [exact F | apply put_becomes].
      + eapply joins; [apply put_becomes | exact B | exact P | apply put_twice].
    - destruct (joins_to f c p m) eqn:J; [|discriminate]; injection E as <- <-.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. apply TreesEnd.once.
      eapply joins; [exact F | exact B | exact P | apply put_becomes].
    - destruct (existsb (Nat.eqb m) used) eqn:U; [discriminate|]; injection E as <- <-.
      apply TreesEnd.once. eapply founds; [exact F | | apply put_becomes].
      intros I; assert (existsb (Nat.eqb m) used = true); [|congruence]. apply existsb_exists; exists m.
      split; [exact I | apply Nat.eqb_refl].
    - destruct (brick f c e) eqn:B; [injection E as <- <-; now apply TreesEnd.once, brick_acts|].
      destruct e as [p|]; [|discriminate]. destruct (own_label f p) as [m|]; [|discriminate].
      destruct (joins_to f c p m && leaf _ c) eqn:J; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in J; destruct J as [J L]. destruct (joins_spec _ _ _ _ J) as [B' [q P]].
      destruct (leaf_spec _ _ L) as [M O]. eapply TreesEnd.again.
      + apply TreesEnd.once. eapply joins; [exact F | exact B' | exact P | apply put_becomes].
      + eapply marks_leaf; [apply put_becomes | exact M | exact O | apply put_twice].
    - destruct (joins_to f c p m && _) eqn:J; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in J; destruct J as [J L]; apply Nat.ltb_lt in L.
      destruct (joins_spec _ _ _ _ J) as [B [q P]]. apply TreesEnd.once.
      eapply adopted; [exact F | exact B | exact P | exact L | apply put_becomes].
    - destruct (brick f c e) eqn:B; [injection E as <- <-; now apply TreesEnd.once, brick_acts|]. cbn [orb] in E.
      destruct (leaf f c && same_exit r e) eqn:L; [|discriminate]; injection E as <- <-.
      apply andb_true_iff in L; destruct L as [L X]. destruct (leaf_spec _ _ L) as [M O].
      apply same_exit_spec in X as ->. apply TreesEnd.once. eapply marks_leaf; [exact F | exact M | exact O |
        apply put_becomes].
  Qed.

  Lemma steps_writes : forall changes f used g used', changes <> [] -> steps (f, used) changes = Some (g, used') ->
    TreesEnd.writes cell beside f used g used'.
  Proof.
    assert (forall f used g used' h used'', TreesEnd.writes cell beside f used g used' ->
      TreesEnd.writes cell beside g used' h used'' -> TreesEnd.writes cell beside f used h used'') as T.
    { intros f used g used' h used'' W V; induction V as [h used'' A | h used'' i used3 V IH A];
        eapply TreesEnd.again; eauto. }
    induction changes as [|change changes IH]; intros f used g used' N E; [contradiction|]. cbn [steps] in E.
    destruct (step _ _) as [[h u]|] eqn:X; [|discriminate]. apply step_writes in X.
    destruct changes as [|next changes]; [injection E as <- <-; exact X|]. eapply T; [exact X|].
    apply IH; [discriminate | exact E].
  Qed.

  Lemma walk_spec : forall f c d, walk f c d = true -> TreesEnd.walks cell f c d.
  Proof.
    intros f c d W; unfold walk in W. destruct (f c) as [| | |m q|e] eqn:F; try discriminate.
    - destruct (f d) as [| | |l r|] eqn:E; try discriminate. apply orb_true_iff in W; destruct W as [W|W].
      + apply andb_true_iff in W; destruct W as [L X]; apply Nat.eqb_eq in L; apply same_exit_spec in X; subst.
        eapply TreesEnd.to_child; eauto.
      + apply Nat.ltb_lt in W; eapply TreesEnd.to_higher; eauto.
    - apply orb_true_iff in W; destruct W as [W|W].
      + eapply TreesEnd.leaves; [exact F | now apply accessible_spec].
      + apply same_exit_spec in W as ->. now apply TreesEnd.follows.
  Qed.

  Lemma last_spec : forall f c, is_last f c = true -> f c = Visited cell None.
  Proof. intros f c L; unfold is_last in L; destruct (f c) as [| | | |[e|]]; try discriminate; reflexivity. Qed.

  Lemma take_run : forall cells n f used w past a g used' w' past', TreesEnd.run cell beside cells n f used w past ->
    take n (f, used, w, past) a = Some (g, used', w', past') -> TreesEnd.run cell beside cells n g used' w' past'.
  Proof.
    intros cells n f used w past [[[[i missed] way] here] changes] g used' w' past' R E; unfold take in E.
    destruct (w i) as [[c may]|] eqn:W; [|discriminate]. destruct ((i <? n) && cell_eqb c here) eqn:L; [|discriminate].
    apply andb_true_iff in L; destruct L as [L _]; apply Nat.ltb_lt in L.
    destruct changes as [|change changes].
    - destruct (goes here way) as [d|] eqn:G.
      + destruct (walk f c d || (may || missed)) eqn:K; [|discriminate]; injection E as <- <- <- <-.
        apply (TreesEnd.then_ cell beside cells n f used w past i c may missed f used (Some (d, missed))); auto.
        apply orb_true_iff in K; destruct K as [K|K]; [apply TreesEnd.walks_on, walk_spec,
          K | now apply TreesEnd.strays].
      + destruct (is_last f c) eqn:K; [|discriminate]; injection E as <- <- <- <-.
        apply (TreesEnd.then_ cell beside cells n f used w past i c may missed f used None); auto.
        now apply TreesEnd.ends, last_spec.
    - destruct (steps (f, used) (change :: changes)) as [[h u]|] eqn:K; [|destruct (goes here way); discriminate].
      apply steps_writes in K; [|discriminate]. destruct (goes here way) as [d|] eqn:G.
      + injection E as <- <- <- <-.
        apply (TreesEnd.then_ cell beside cells n f used w past i c may missed h u (Some (d, true))); auto.
        now apply TreesEnd.goes_on.
      + destruct (is_last h c) eqn:Z; [|discriminate]; injection E as <- <- <- <-.
        apply (TreesEnd.then_ cell beside cells n f used w past i c may missed h u None); auto.
        apply TreesEnd.writes_and_ends; [exact K | now apply last_spec].
  Qed.

  Lemma replay_run : forall cells n actions s f used w past,
    (let '(f, used, w, past) := s in TreesEnd.run cell beside cells n f used w past) ->
    replay n s actions = Some (f, used, w, past) -> TreesEnd.run cell beside cells n f used w past.
  Proof.
    intros cells n; induction actions as [|a actions IH]; intros [[[f used] w] past] g used' w' past' R E;
      cbn [replay] in E; [injection E as <- <- <- <-; exact R|].
    destruct (take _ _ _) as [[[[h u] x] p]|] eqn:T; [|discriminate]. eapply IH; [|exact E]. eapply take_run; eauto.
  Qed.

  Lemma started : forall cells starts, all_joined (is_in cells) cells = true ->
    (forall c, start_floor cells starts c = Wall cell \/ start_floor cells starts c = Unexplored cell
      \/ start_floor cells starts c = Explored cell)
    /\ (forall c, start_floor cells starts c <> Wall cell -> In c cells)
    /\ Marking.connected cell beside (accessible cell (start_floor cells starts)).
  Proof.
    intros cells starts C.
    assert (forall c, is_in cells c = true <-> accessible cell (start_floor cells starts) c) as OK.
    { intros c; unfold accessible, start_floor; destruct (is_in cells c); [destruct (is_in starts c)|]; split; auto;
        discriminate || contradiction. }
    split; [|split].
    - intros c; unfold start_floor; destruct (is_in cells c); [destruct (is_in starts c)|]; auto.
    - intros c N; unfold start_floor in N; apply is_in_spec; destruct (is_in cells c); [reflexivity | contradiction].
    - intros a b Fa Fb; eapply all_joined_ways; [exact OK | | exact C | |]; try (now apply is_in_spec, OK).
      intros c I0; now apply OK, is_in_spec.
  Qed.

  Lemma ends_with_spec : forall ok cells starts actions, ends_with ok cells starts actions = true ->
    exists f used w past, replay (length starts) (start cells starts) actions = Some (f, used, w, past)
      /\ ok (f, used, w, past) = true /\ TreesEnd.run cell beside cells (length starts) f used w past.
  Proof.
    intros ok cells starts actions A; apply andb_true_iff in A; destruct A as [C A].
    destruct (replay _ _ _) as [[[[f used] w] past]|] eqn:E; [|discriminate]. exists f, used, w, past.
    split; [reflexivity|]. split; [exact A|]. eapply replay_run; [|exact E].
    destruct (started cells starts C) as [S [I J]]. apply TreesEnd.begins; auto. discriminate.
  Qed.
End Replay.

Definition recorded : Type := list cell * list edge * list cell * list action.
Definition recorded_runs : list (list recorded) := [runs_tree; runs_helpers; runs_careful].
Definition all_done (n : nat) (s : state) : bool :=
  let '(_, _, w, _) := s in forallb (fun i => match w i with None => true | Some _ => false end) (seq 0 n).

Lemma all_recorded : forallb (forallb (fun r : recorded =>
  let '(cells, walls, first, actions) := r in ends_with walls (all_done (length first)) cells first actions))
    recorded_runs
  = true.
Proof. vm_compute; reflexivity. Qed.

(** Every run of the kernel is one of TreesEnd.v, turn by turn, until all agents are done; so it is one of Trees.v. *)
Theorem kernel_trees_run : forall rs cells walls starts actions, In rs recorded_runs ->
  In (cells, walls, starts, actions) rs ->
  exists f used w past, replay walls (length starts) (start cells starts) actions = Some (f, used, w, past)
    /\ TreesEnd.run cell (beside walls) cells (length starts) f used w past
    /\ Trees.run cell (beside walls) f used /\ (forall i, i < length starts -> w i = None).
Proof.
  intros rs cells walls starts actions I J; pose proof all_recorded as A.
  rewrite forallb_forall in A; specialize (A _ I); rewrite forallb_forall in A; specialize (A _ J).
  cbn beta iota in A. destruct (ends_with_spec _ _ _ _ _ A) as [f [used [w [past [E [D R]]]]]].
  exists f, used, w, past. repeat split; [exact E | exact R | eapply TreesEnd.run_of_trees; exact R|].
  intros i L; unfold all_done in D; rewrite forallb_forall in D. specialize (D i); destruct (w i); [|reflexivity].
  discriminate D; apply in_seq; lia.
Qed.

(** How many moves an agent has made. *)
Definition moves_of (i : nat) (past : TreesEnd.history cell) : nat :=
  length (filter (fun t => (fst (fst t) =? i) && match snd t with Some _ => true | None => false end) past).
Definition beyond_moves (most : nat) (cells : list cell) (s : state) : bool :=
  let '(_, used, _, past) := s in (length used <=? 1) && (most * length cells <? moves_of 0 past).

Lemma too_many : forall most rs, forallb (fun r : recorded => let '(cells, walls, first, actions) := r in
    ends_with walls (beyond_moves most cells) cells first actions) rs = true ->
  forall cells walls starts actions, In (cells, walls, starts, actions) rs ->
  exists f used w past, replay walls (length starts) (start cells starts) actions = Some (f, used, w, past)
    /\ TreesEnd.run cell (beside walls) cells (length starts) f used w past
    /\ length used <= 1 /\ most * length cells < moves_of 0 past.
Proof.
  intros most rs A cells walls starts actions J. rewrite forallb_forall in A; specialize (A _ J).
  cbn beta iota in A. destruct (ends_with_spec _ _ _ _ _ A) as [f [used [w [past [E [D R]]]]]].
  exists f, used, w, past. apply andb_true_iff in D; destruct D as [D D']; apply Nat.leb_le in D;
    apply Nat.ltb_lt in D'.
  auto.
Qed.

(** BRICKS-10 does not hold of brick-tree, not even with four moves a cell: in this run of the kernel, of two agents in
    twelve cells, the first makes more, though there is one tree. *)
Theorem four_moves_are_not_enough_for_brick_tree : length runs_of_many_moves = 1 /\
  forall cells walls starts actions, In (cells, walls, starts, actions) runs_of_many_moves ->
  exists f used w past, replay walls (length starts) (start cells starts) actions = Some (f, used, w, past)
    /\ TreesEnd.run cell (beside walls) cells (length starts) f used w past
    /\ length used <= 1 /\ 4 * length cells < moves_of 0 past.
Proof. split; [reflexivity | apply too_many; vm_compute; reflexivity]. Qed.

(** BRICKS-12 does not hold of brick-tree: in this run of the kernel an agent alone makes more than two moves a cell. *)
Theorem two_moves_are_not_enough_for_brick_tree : length runs_of_a_brick_tree_alone = 1 /\
  forall cells walls starts actions, In (cells, walls, starts, actions) runs_of_a_brick_tree_alone ->
  exists f used w past, replay walls (length starts) (start cells starts) actions = Some (f, used, w, past)
    /\ TreesEnd.run cell (beside walls) cells (length starts) f used w past
    /\ length used <= 1 /\ 2 * length cells < moves_of 0 past.
Proof. split; [reflexivity | apply too_many; vm_compute; reflexivity]. Qed.
