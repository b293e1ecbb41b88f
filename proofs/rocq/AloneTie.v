(** The tie between the kernel, TreesAlone.v and TreesOne.v: the kernel's runs of helpers are runs of TreesOne.v, and
    those of a helper alone of TreesAlone.v, too. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Trees TreesTie.
From Tautline Require TreesAlone TreesOne.
From Tautline.generated Require Import TreesAnswers.
Import ListNotations.

Section Alone.
  Variable walls : list edge.
  Notation floor := (Trees.floor cell).
  Definition none_beside (f : floor) (c : cell) (p : note cell -> bool) : bool :=
    forallb (fun d => negb (p (f d))) (sides_of walls c).
  Definition note_eqb (a b : note cell) : bool :=
    match a, b with
    | Wall _, Wall _ | Unexplored _, Unexplored _ | Explored _, Explored _ => true
    | Open _ l q, Open _ m r => (l =? m) && same_exit q r
    | Visited _ q, Visited _ r => same_exit q r
    | _, _ => false
    end.
  Definition is_of (p : nat -> bool) (n : note cell) : bool := match n with Open _ l _ => p l | _ => false end.
  Definition is_child (c : cell) (n : note cell) : bool := match n with Open _ _ q => same_exit q (Some c) | _ =>
    false end.

  (** The cell of an agent as one of a tree: it is already, it joins one beside it, or it founds one. What it says after
      the turn tells which. *)
  Definition joins_of (f : floor) (used : list nat) (c p : cell) : option (floor * list nat * nat) :=
    match f p with
    | Open _ m _ => if is_in (sides_of walls c) p && none_beside f c (is_of (fun l => m <? l))
        then Some (put f c (Open cell m (Some p)), used, m) else None
    | _ => None
    end.
  Definition founds_of (f : floor) (used : list nat) (c : cell) (m : nat) : option (floor * list nat * nat) :=
    if none_beside f c (is_of (fun _ => true)) && negb (existsb (Nat.eqb m) used)
    then Some (put f c (Open cell m None), m :: used, m) else None.
  Definition start_tree (f : floor) (used : list nat) (c : cell) (said : note cell)
    : option (floor * list nat * nat) :=
    match f c, said with
    | Open _ m _, _ => Some (f, used, m)
    | Explored _, (Open _ _ (Some p) | Visited _ (Some p)) => joins_of f used c p
    | Explored _, Open _ m None => founds_of f used c m
    | Explored _, Visited _ None => founds_of f used c (S (list_max used))
    | _, _ => None
    end.
  Definition finish (f : floor) (c : cell) (m : nat) (next : option cell) : option floor :=
    match f c with
    | Open _ _ q =>
        if same_exit q next && none_beside f c (note_eqb (Unexplored cell)) && none_beside f c (note_eqb (Explored
          cell))
          && none_beside f c (is_of (fun l => l <? m)) && none_beside f c (is_child c)
          && none_beside f c (is_of (fun l => m <? l))
        then Some (put f c (Visited cell q)) else None
    | _ => None
    end.
  Definition goes_on (f : floor) (c : cell) (m : nat) (next : option cell) : option floor :=
    let explored := none_beside f c (note_eqb (Unexplored cell)) in
    let adopted := explored && none_beside f c (note_eqb (Explored cell)) in
    let all_adopted := adopted && none_beside f c (is_of (fun l => l <? m)) in
    match next with
    | Some d =>
        let child := Some (put f d (Open cell m (Some c))) in
        if is_in (sides_of walls c) d then match f d with
          | Unexplored _ => child
          | Explored _ => if explored then child else None
          | Open _ l q => if (l <? m) && adopted then child else
              if same_exit q (Some c) && all_adopted then Some f else
              if (m <? l) && all_adopted && none_beside f c (is_child c) then Some f else finish f c m next
          | _ => None
          end
        else None
    | None => finish f c m next
    end.
  Definition helper_step (f : floor) (used : list nat) (c : cell) (said : note cell) (next : option cell)
    : option (floor * list nat) :=
    match f c with
    | Visited _ e => if same_exit e next then Some (f, used) else None
    | _ => match start_tree f used c said with
        | Some (g, used', m) => option_map (fun h => (h, used')) (goes_on g c m next)
        | None => None
        end
    end.

  (** What the sensors say after a turn. *)
  Definition told (f : floor) (changes : list (cell * (nat * nat * nat))) : floor :=
    fold_left (fun g change => put g (fst change) (note_of (fst change) (snd change))) changes f.
  Definition turn (cells : list cell) (f : floor) (used : list nat) (at_ : option cell) (a : action)
    : option (floor * list nat * option cell) :=
    let '(_, _, way, here, changes) := a in
    match at_ with
    | Some c =>
        let said := told f changes in
        match helper_step f used c (said c) (goes here way) with
        | Some (g, used') => if cell_eqb c here && forallb (fun d => note_eqb (g d) (said d)) cells
            then Some (g, used', goes here way) else None
        | None => None
        end
    | None => None
    end.
  Fixpoint alone_replay (cells : list cell) (f : floor) (used : list nat) (at_ : option cell) (actions : list action)
    : bool :=
    match actions with
    | [] => match at_ with None => true | Some _ => false end
    | a :: actions => match turn cells f used at_ a with
        | Some (g, used', next) => alone_replay cells g used' next actions
        | None => false
        end
    end.
  Fixpoint team_replay (cells : list cell) (n : nat) (f : floor) (used : list nat) (w : nat -> option cell)
    (actions : list action) : bool :=
    match actions with
    | [] => forallb (fun i => match w i with None => true | Some _ => false end) (seq 0 n)
    | a :: actions => let i := fst (fst (fst (fst a))) in
        match turn cells f used (w i) a with
        | Some (g, used', next) => (i <? n) && team_replay cells n g used' (TreesOne.put cell w i next) actions
        | None => false
        end
    end.

  Lemma none_spec : forall f c p (P : note cell -> Prop), none_beside f c p = true -> (forall n, P n -> p n = true) ->
    TreesAlone.none cell (beside walls) f c P.
  Proof.
    intros f c p P N H d B X; unfold none_beside in N; rewrite forallb_forall in N. specialize (N d B).
    rewrite (H _ X) in N; discriminate.
  Qed.
  Lemma is_of_spec : forall (p : nat -> bool) (P : nat -> Prop), (forall l, P l -> p l = true) -> forall n,
    TreesAlone.of_tree cell P n -> is_of p n = true.
  Proof. intros p P H n [l [q [-> L]]]; now apply H. Qed.

  Lemma start_tree_joined : forall f used c said g used' m, start_tree f used c said = Some (g, used', m) ->
    TreesAlone.joined cell (beside walls) f used c g used' m.
  Proof.
    intros f used c said g used' m S.
    assert (forall p, f c = Explored cell -> joins_of f used c p = Some (g, used', m) ->
      TreesAlone.joined cell (beside walls) f used c g used' m) as JOIN.
    { intros p F J; unfold joins_of in J; destruct (f p) as [| | |l q|] eqn:P; try discriminate.
      destruct (is_in _ p && _) eqn:B; [|discriminate]; injection J as <- <- <-.
      apply andb_true_iff in B; destruct B as [B N]; apply is_in_spec in B.
      apply TreesAlone.beside_one with p q; [exact F | exact B | exact P | | apply put_becomes].
      eapply none_spec; [exact N|]. apply is_of_spec; intros k K; apply Nat.ltb_lt; lia. }
    assert (forall k, f c = Explored cell -> founds_of f used c k = Some (g, used', m) ->
      TreesAlone.joined cell (beside walls) f used c g used' m) as FOUND.
    { intros k F J; unfold founds_of in J; destruct (none_beside f c _ && _) eqn:B; [|discriminate].
      injection J as <- <- <-; apply andb_true_iff in B; destruct B as [N U].
      apply TreesAlone.of_its_own; [exact F | eapply none_spec; [exact N|]; now apply is_of_spec | | apply put_becomes].
      intros I; apply negb_true_iff in U. assert (existsb (Nat.eqb k) used = true); [|congruence].
      apply existsb_exists; exists k; split; [exact I | apply Nat.eqb_refl]. }
    unfold start_tree in S; destruct (f c) as [| | |l q|] eqn:F; try discriminate.
    - destruct said as [| | |l [p|]|[p|]]; try discriminate; eauto.
    - injection S as <- <- <-; now apply TreesAlone.of_one with q.
  Qed.

  Lemma finish_helps : forall f c m q next g, f c = Open cell m q -> finish f c m next = Some g ->
    TreesAlone.helps cell (beside walls) f c m g next.
  Proof.
    intros f c m q next g F H; unfold finish in H; rewrite F in H.
    destruct (same_exit q next && _ && _ && _ && _ && _) eqn:A; [|discriminate]. injection H as <-.
    rewrite !andb_true_iff in A; destruct A as [[[[[X N1] N2] N3] N4] N5]. apply same_exit_spec in X as <-.
    apply TreesAlone.is_finished; [ | | | | | exact F | apply put_becomes].
    - eapply none_spec; [exact N1|]. now intros n <-.
    - eapply none_spec; [exact N2|]. now intros n <-.
    - eapply none_spec; [exact N3|]. apply is_of_spec; intros k K; apply Nat.ltb_lt; lia.
    - eapply none_spec; [exact N4|]. intros n [k ->]; apply (proj2 (cell_eqb_spec c c) eq_refl).
    - eapply none_spec; [exact N5|]. apply is_of_spec; intros k K; apply Nat.ltb_lt; lia.
  Qed.

  Lemma goes_on_helps : forall f c m q next g, f c = Open cell m q -> goes_on f c m next = Some g ->
    TreesAlone.helps cell (beside walls) f c m g next.
  Proof.
    intros f c m q next g F H; unfold goes_on in H; destruct next as [d|]; [|eapply finish_helps; eauto].
    destruct (is_in _ d) eqn:B; [|discriminate]; apply is_in_spec in B.
    assert (none_beside f c (note_eqb (Unexplored cell)) = true ->
      TreesAlone.none cell (beside walls) f c (eq (Unexplored cell))) as N1
      by (intros N; eapply none_spec; [exact N|]; now intros n <-).
    assert (none_beside f c (note_eqb (Explored cell)) = true ->
      TreesAlone.none cell (beside walls) f c (eq (Explored cell))) as N2
      by (intros N; eapply none_spec; [exact N|]; now intros n <-).
    assert (none_beside f c (is_of (fun l => l <? m)) = true ->
      TreesAlone.none cell (beside walls) f c (TreesAlone.of_tree cell (gt m))) as N3
      by (intros N; eapply none_spec; [exact N|]; apply is_of_spec; intros k K; apply Nat.ltb_lt; lia).
    destruct (f d) as [| | |l r|] eqn:D; try discriminate.
    - injection H as <-. apply TreesAlone.explores; [exact B | exact D | apply put_becomes].
    - destruct (none_beside f c _) eqn:N; [|discriminate]; injection H as <-.
      apply TreesAlone.adopts; [auto | exact B | auto | apply put_becomes].
    - destruct ((l <? m) && _) eqn:A.
      { injection H as <-. rewrite !andb_true_iff in A; destruct A as [L [N N']]; apply Nat.ltb_lt in L.
        apply TreesAlone.adopts; [auto | exact B | right; split; [auto | exists l, r; split; [exact D | lia]] |
          apply put_becomes]. }
      destruct (same_exit r (Some c) && _) eqn:A'.
      { injection H as <-. rewrite !andb_true_iff in A'; destruct A' as [L [[N N'] N'']].
        apply same_exit_spec in L as ->. apply TreesAlone.goes_down; auto. exists l; exact D. }
      destruct ((m <? l) && _ && _) eqn:A''; [|eapply finish_helps; eauto].
      injection H as <-. rewrite !andb_true_iff in A''; destruct A'' as [[L [[N N'] N'']] N4]; apply Nat.ltb_lt in L.
      apply TreesAlone.goes_over; auto; [|exists l, r; split; [exact D | exact L]].
      eapply none_spec; [exact N4|]. intros n [k ->]; apply (proj2 (cell_eqb_spec c c) eq_refl).
  Qed.

  Lemma helper_step_act : forall f used c said next g used', helper_step f used c said next = Some (g, used') ->
    TreesAlone.act cell (beside walls) f used c g used' next.
  Proof.
    intros f used c said next g used' E; unfold helper_step in E.
    assert (match start_tree f used c said with
      | Some (g, used', m) => option_map (fun h => (h, used')) (goes_on g c m next) | None => None end
      = Some (g, used') -> TreesAlone.act cell (beside walls) f used c g used' next) as NOT.
    { intros X; destruct (start_tree f used c said) as [[[h u] m]|] eqn:S; [|discriminate].
      apply start_tree_joined in S. destruct (goes_on h c m next) as [i|] eqn:H; [|discriminate].
      injection X as <- <-. assert (exists q, h c = Open cell m q) as [q F].
      { destruct S as [m q F | p m q h F B P N [Hc _] | m h F N U [Hc _]]; eauto. }
      eapply TreesAlone.is_not; [exact S | eapply goes_on_helps; eauto]. }
    destruct (f c) as [| | | |e] eqn:F; auto. destruct (same_exit e next) eqn:X; [|discriminate].
    injection E as <- <-; apply same_exit_spec in X as <-. now apply TreesAlone.is_visited.
  Qed.

  Lemma turn_act : forall cells f used at_ a g used' next, turn cells f used at_ a = Some (g, used', next) ->
    exists c, at_ = Some c /\ TreesAlone.act cell (beside walls) f used c g used' next.
  Proof.
    intros cells f used at_ [[[[i missed] way] here] changes] g used' next T; unfold turn in T.
    destruct at_ as [c|]; [|discriminate]. exists c; split; [reflexivity|].
    destruct (helper_step _ _ _ _ _) as [[h u]|] eqn:S; [|discriminate].
    destruct (cell_eqb c here && _); [|discriminate]. injection T as <- <- <-. eapply helper_step_act; exact S.
  Qed.

  Lemma alone_replay_run : forall cells actions f used at_ k, TreesAlone.alone cell (beside walls) cells f used at_ k ->
    alone_replay cells f used at_ actions = true ->
    exists g used', TreesAlone.alone cell (beside walls) cells g used' None (k + length actions).
  Proof.
    intros cells; induction actions as [|a actions IH]; intros f used at_ k A E; cbn [alone_replay length] in *.
    - destruct at_; [discriminate|]. rewrite Nat.add_0_r; eauto.
    - destruct (turn _ _ _ _ _) as [[[g used'] next]|] eqn:T; [|discriminate].
      destruct (turn_act _ _ _ _ _ _ _ _ T) as [c [-> X]].
      rewrite <- plus_n_Sm; apply (IH g used' next (S k)); [|exact E]. eapply TreesAlone.acts_on; eauto.
  Qed.

  Lemma team_replay_run : forall cells n actions f used w past,
    TreesOne.run cell (beside walls) cells n f used w past -> team_replay cells n f used w actions = true ->
    exists g used' w' past', TreesOne.run cell (beside walls) cells n g used' w' past'
      /\ length past' = length past + length actions /\ forall i, i < n -> w' i = None.
  Proof.
    intros cells n; induction actions as [|a actions IH]; intros f used w past R E; cbn [team_replay length] in *.
    - exists f, used, w, past. split; [exact R|]. split; [lia|]. intros i L; rewrite forallb_forall in E.
      specialize (E i); destruct (w i); [|reflexivity]. discriminate E; apply in_seq; lia.
    - destruct (turn _ _ _ _ _) as [[[g used'] next]|] eqn:T; [|discriminate].
      destruct (turn_act _ _ _ _ _ _ _ _ T) as [c [W X]]. apply andb_true_iff in E; destruct E as [L E];
        apply Nat.ltb_lt in L. destruct (IH g used' _ _ (TreesOne.then_ _ _ _ _ _ _ _ _ _ _ _ _ _ R L W X) E)
        as [h [u [w' [past' [R' [N D]]]]]]. exists h, u, w', past'; cbn [length] in N. repeat split; auto; lia.
  Qed.

  Definition team_run (r : recorded) : bool :=
    let '(cells, _, first, actions) := r in
    forallb (is_in cells) first
    && team_replay cells (length first) (start_floor cells first) [] (fun i => nth_error first i) actions.
  Definition alone_run (r : recorded) : bool :=
    let '(cells, _, first, actions) := r in
    match first with
    | [s] => is_in cells s && alone_replay cells (start_floor cells first) [] (Some s) actions
    | _ => false
    end.
End Alone.

Definition is_alone (r : recorded) : bool := let '(_, _, first, _) := r in length first =? 1.
Definition alone_in (rs : list recorded) : list recorded := filter is_alone rs.
Lemma all_alone : forallb (fun r => alone_run (snd (fst (fst r))) r) (alone_in runs_helpers) = true.
Proof. vm_compute; reflexivity. Qed.

(** Every run of a helper alone is one of TreesAlone.v, turn by turn, until it is done; none of brick-tree alone is. *)
Theorem kernel_helpers_alone : 3 <= length (alone_in runs_helpers) /\
  (forall cells walls starts actions, In (cells, walls, starts, actions) (alone_in runs_helpers) ->
    exists f used, TreesAlone.alone cell (beside walls) cells f used None (length actions)) /\
  existsb (fun r => alone_run (snd (fst (fst r))) r) (alone_in (runs_tree ++ runs_of_a_brick_tree_alone)) = false.
Proof.
  split; [cbn; lia|]. split; [|vm_compute; reflexivity].
  intros cells walls starts actions I; pose proof all_alone as A. rewrite forallb_forall in A; specialize (A _ I).
  cbn [fst snd alone_run] in A. destruct starts as [|s [|? ?]]; try discriminate.
  apply andb_true_iff in A; destruct A as [C A]. refine (alone_replay_run walls cells actions _ [] (Some s) 0 _ A).
  apply TreesAlone.sets_out; unfold start_floor.
  - intros c N; apply is_in_spec; destruct (is_in cells c); [reflexivity | contradiction].
  - rewrite C; cbn. now rewrite (proj2 (cell_eqb_spec s s) eq_refl).
  - intros c N; destruct (is_in cells c); [|auto]. cbn. destruct (cell_eqb c s) eqn:X; [|auto].
    apply cell_eqb_spec in X; congruence.
Qed.

Lemma all_teams : forallb (fun r => team_run (snd (fst (fst r))) r) runs_helpers = true.
Proof. vm_compute; reflexivity. Qed.

(** Every run of the kernel's helpers is one of TreesOne.v, turn by turn, until all are done. *)
Theorem kernel_helpers_run : forall cells walls starts actions, In (cells, walls, starts, actions) runs_helpers ->
  exists f used w past, TreesOne.run cell (beside walls) cells (length starts) f used w past
    /\ length past = length actions /\ forall i, i < length starts -> w i = None.
Proof.
  intros cells walls starts actions I; pose proof all_teams as A. rewrite forallb_forall in A; specialize (A _ I).
  cbn [fst snd team_run] in A. apply andb_true_iff in A; destruct A as [C A]; rewrite forallb_forall in C.
  refine (team_replay_run walls cells (length starts) actions _ [] _ [] _ A). apply TreesOne.begins; unfold start_floor.
  - intros c; destruct (is_in cells c); [destruct (is_in starts c)|]; auto.
  - intros c N; apply is_in_spec; destruct (is_in cells c); [reflexivity | contradiction].
  - intros i L; destruct (nth_error starts i) as [c|] eqn:E; [|apply nth_error_None in E; lia].
    exists c; split; [exact E|]. apply nth_error_In in E. rewrite (C c E).
    now rewrite (proj2 (is_in_spec starts c) E).
Qed.
