(** The tie between the kernel and TreesAlone.v: the kernel's runs of a helper alone are runs of TreesAlone.v. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Trees TreesTie.
From Tautline Require TreesAlone.
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

  (** The first tree is the tree 0. *)
  Definition start_tree (f : floor) (used : list nat) (c : cell) : option (floor * list nat * nat) :=
    match f c, used with
    | Open _ m _, _ => Some (f, used, m)
    | Explored _, [] => if none_beside f c (is_of (fun _ => true)) then Some (put f c (Open cell 0 None), [0],
        0) else None
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
  Definition alone_step (f : floor) (used : list nat) (c : cell) (next : option cell) : option (floor * list nat) :=
    match start_tree f used c with
    | Some (g, used', m) =>
        let finished := match finish g c m next with Some h => Some (h, used') | None => None end in
        match next with
        | Some d => match g d with
            | Unexplored _ => if is_in (sides_of walls c) d then Some (put g d (Open cell m (Some c)), used') else None
            | _ => finished
            end
        | None => finished
        end
    | None => None
    end.
  Fixpoint alone_replay (cells : list cell) (f : floor) (used : list nat) (at_ : option cell) (actions : list action)
    : bool :=
    match actions, at_ with
    | [], None => true
    | (_, _, way, here, changes) :: actions, Some c =>
        let next := goes here way in
        match alone_step f used c next with
        | Some (g, used') =>
            let said := fold_left (fun g change => put g (fst change) (note_of (fst change) (snd change))) changes f in
            cell_eqb c here && forallb (fun d => note_eqb (g d) (said d)) cells && alone_replay cells g used' next
              actions
        | None => false
        end
    | _, _ => false
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

  Lemma alone_step_act : forall f used c next g used', alone_step f used c next = Some (g, used') ->
    TreesAlone.act cell (beside walls) f used c g used' next.
  Proof.
    intros f used c next g used' E; unfold alone_step in E.
    destruct (start_tree f used c) as [[[h u] m]|] eqn:S; [|discriminate].
    assert (TreesAlone.joined cell (beside walls) f used c h u m) as J.
    { unfold start_tree in S; destruct (f c) as [| | |l q|] eqn:F; try discriminate.
      - destruct used as [|? ?]; [|discriminate]. destruct (none_beside f c _) eqn:N; [|discriminate].
        injection S as <- <- <-. apply TreesAlone.of_its_own; [exact F | | intros [] | apply put_becomes].
        eapply none_spec; [exact N|]. now apply is_of_spec.
      - injection S as <- <- <-; now apply TreesAlone.of_one with q. }
    assert (forall i, finish h c m next = Some i -> TreesAlone.helps cell (beside walls) h c m i next) as FI.
    { intros i H; unfold finish in H; destruct (h c) as [| | |l q|] eqn:F; try discriminate.
      destruct (same_exit q next && _ && _ && _ && _ && _) eqn:A; [|discriminate]. injection H as <-.
      rewrite !andb_true_iff in A; destruct A as [[[[[X N1] N2] N3] N4] N5]. apply same_exit_spec in X as <-.
      assert (l = m) as -> by (destruct J; [congruence | |];
        match goal with B : becomes _ _ _ _ _ |- _ => destruct B as [B _]; congruence end).
      apply TreesAlone.is_finished; [ | | | | | exact F | apply put_becomes].
      - eapply none_spec; [exact N1|]. now intros n <-.
      - eapply none_spec; [exact N2|]. now intros n <-.
      - eapply none_spec; [exact N3|]. apply is_of_spec; intros k K; apply Nat.ltb_lt; lia.
      - eapply none_spec; [exact N4|]. intros n [k ->]; apply (proj2 (cell_eqb_spec c c) eq_refl).
      - eapply none_spec; [exact N5|]. apply is_of_spec; intros k K; apply Nat.ltb_lt; lia. }
    assert (u = used' /\ TreesAlone.helps cell (beside walls) h c m g next) as [<- H];
      [|eapply TreesAlone.is_not; eauto].
    assert (match finish h c m next with Some i => Some (i, u) | None => None end = Some (g, used') ->
      u = used' /\ TreesAlone.helps cell (beside walls) h c m g next) as FIN.
    { destruct (finish h c m next) as [i|]; [|discriminate]. intros Y; injection Y as <- <-; auto. }
    destruct next as [d|]; [|auto]. destruct (h d) eqn:D; auto.
    destruct (is_in _ d) eqn:I; [|discriminate]. injection E as <- <-. split; [reflexivity|].
    apply TreesAlone.explores; [now apply is_in_spec | exact D | apply put_becomes].
  Qed.

  Lemma alone_replay_run : forall cells actions f used at_ k, TreesAlone.alone cell (beside walls) cells f used at_ k ->
    alone_replay cells f used at_ actions = true ->
    exists g used', TreesAlone.alone cell (beside walls) cells g used' None (k + length actions).
  Proof.
    intros cells; induction actions as [|[[[[i missed] way] here] changes] actions IH]; intros f used at_ k A E;
      cbn [alone_replay length] in *.
    - destruct at_; [discriminate|]. rewrite Nat.add_0_r; eauto.
    - destruct at_ as [c|]; [|discriminate]. destruct (alone_step f used c (goes here way)) as [[g used']|] eqn:X;
        [|discriminate]. rewrite !andb_true_iff in E; destruct E as [_ E].
      rewrite <- plus_n_Sm; apply (IH g used' (goes here way) (S k)); [|exact E].
      eapply TreesAlone.acts_on; [exact A | now apply alone_step_act].
  Qed.

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
