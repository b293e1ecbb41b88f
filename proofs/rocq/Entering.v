(** FRONTIER-2: two robots that explore cells are never in one cell, nor on their way into one, for every number of robots,
    every graph of cells, every set of obstacles and every run of Explorers.v, by any rule. A robot enters a cell only where it
    has looked and met nobody: neither in it, nor at its rim, nor on the way into it. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Explorers.
Import ListNotations.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (obstacle : V -> bool).
  Variables (N : nat) (rl : rule V).
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Notation world := (world V).
  Notation leads := (leads V same obstacle N rl).

  Definition body (r : robot V) : V * stance V := (place r, doing r).
  Lemma body_told : forall (f : nat -> robot V) l r, body (fold_left (fun r j => hears V same r j (f j)) l r) = body r.
  Proof. intros f l; induction l as [|k l IH]; intros r; cbn; [reflexivity | now rewrite IH]. Qed.
  Lemma body_tells : forall f j ms i, body (tells V same f j ms i) = body (f i).
  Proof. intros f j ms i; unfold tells; destruct (_ || _); reflexivity. Qed.

  (** What a step makes of robot [i]. *)
  Inductive turns (w : world) (i : nat) : event V -> V * stance V -> Prop :=
  | turns_not : forall e, turns w i e (body (robots w i))
  | turns_to : forall v c ms, doing (robots w i) = Stands ->
      turns w i (Decides i v c ms) (place (robots w i), Tries v)
  | turns_away : forall v ms un sl, doing (robots w i) = Tries v -> turns w i (Looks i ms un sl) (place (robots w i), Stands)
  | turns_in : forall v ms un sl, doing (robots w i) = Tries v -> meets V same N w i v = [] -> obstacle v = false ->
      turns w i (Looks i ms un sl) (place (robots w i), Enters v)
  | turns_up : forall v ms, doing (robots w i) = Enters v -> turns w i (Arrives i ms) (v, Stands).

  Lemma step_turns : forall w e w', leads w e w' -> forall i, i < N -> turns w i e (body (robots w' i)).
  Proof.
    intros w e w' [x [E [A _]]] i I; rewrite <- A by exact I. clear A.
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-; cbn [robots with_robots].
      rewrite !andb_true_iff in G; destruct G as [[_ G] _]; unfold may_decide, moves in G; rewrite !andb_true_iff in G.
      assert (body ((if claims rl then tells V same (put (robots w) j (becomes V (robots w j) (Tries v) (Some c)
        (waits (robots w j)))) j ms else put (robots w) j (becomes V (robots w j) (Tries v) (Some c) (waits (robots w j)))) i)
        = if i =? j then (place (robots w j), Tries v) else body (robots w i)) as ->.
      { destruct (claims rl); rewrite ?body_tells; unfold put; destruct (i =? j); reflexivity. }
      destruct (Nat.eqb_spec i j) as [->|D]; [|apply turns_not]. apply turns_to.
      destruct (doing (robots w j)); [reflexivity | now destruct G as [[G _] _]..].
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (negb _); [discriminate|].
      destruct (meets V same N w j v) as [|k met] eqn:M; injection E as <-; rewrite (proj1 (settle_robots _ _ _ _));
        cbn [robots with_robots].
      + assert (forall o l : bool, let r := if o then blocks V same (robots w j) v else if l then Explorers.turns V (robots w j)
            else becomes V (robots w j) (Enters v) (aim (robots w j)) false in
          body ((if o then tells V same (put (robots w) j r) j ms else put (robots w) j r) i)
          = if i =? j then (place (robots w j), if o || l then Stands else Enters v) else body (robots w i)) as S.
        { intros [|] [|]; cbn zeta; rewrite ?body_tells; unfold put; destruct (i =? j); reflexivity. }
        rewrite S; destruct (Nat.eqb_spec i j) as [->|D]; [|apply turns_not].
        destruct (obstacle v) eqn:O; [eapply turns_away; eauto|]. cbn [orb].
        destruct (late _ _ _ _ _); [eapply turns_away | eapply turns_in]; eauto.
      + assert (forall g, body (is_told V same (tells V same (put (robots w) j (becomes V (robots w j) Stands None true)) j ms)
          j g i) = if i =? j then (place (robots w j), Stands) else body (robots w i)) as S.
        { intros g; unfold is_told; unfold put at 1; destruct (i =? j) eqn:D.
          - rewrite body_told, body_tells; unfold put; now rewrite Nat.eqb_refl.
          - rewrite body_tells; unfold put; now rewrite D. }
        rewrite S; destruct (Nat.eqb_spec i j) as [->|D]; [eapply turns_away; eauto | apply turns_not].
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (j <? N); [|discriminate].
      injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots]. rewrite body_tells; unfold put.
      destruct (Nat.eqb_spec i j) as [->|D]; [apply turns_up; exact Do | apply turns_not].
    - destruct (may_tick V N rl w); [|discriminate]; injection E as <-; exact (turns_not w i Ticks).
  Qed.

  (** The cells that a robot has: its own, and the one that it enters. *)
  Definition holds (x : V * stance V) (v : V) : Prop := v = fst x \/ snd x = Enters v.
  Definition apart (w : world) : Prop := forall i j v, i < N -> j < N -> holds (body (robots w i)) v ->
    holds (body (robots w j)) v -> i = j.

  Lemma meets_none : forall w i v j, meets V same N w i v = [] -> j < N -> j <> i -> ~ holds (body (robots w j)) v.
  Proof.
    intros w i v j M J D H. assert (In j (meets V same N w i v)) as X; [|now rewrite M in X].
    unfold meets; apply filter_In; split; [apply in_seq; lia|]. apply andb_true_iff; split; [now apply negb_true_iff, Nat.eqb_neq|].
    apply orb_true_iff; unfold holds in H; cbn in H; destruct H as [->|H]; [left; now apply same_spec|].
    rewrite H; right; now apply same_spec.
  Qed.

  (** Who acts: one robot at most. *)
  Lemma turns_one : forall w i j e x y, turns w i e x -> turns w j e y -> i <> j -> x = body (robots w i) \/ y = body (robots w j).
  Proof. intros w i j e x y A B D; inversion A; subst; auto; inversion B; subst; auto; contradiction. Qed.

  (** What a robot holds after a step it held before, or nobody else did. *)
  Lemma turns_hold : forall w i e x v, turns w i e x -> holds x v ->
    holds (body (robots w i)) v \/ forall j, j < N -> j <> i -> ~ holds (body (robots w j)) v.
  Proof.
    intros w i e x v T H; destruct T as [e|u c ms S|u ms un sl S|u ms un sl S M O|u ms S]; unfold holds in H; cbn in H.
    - now left.
    - destruct H as [->|H]; [left; now left | discriminate].
    - destruct H as [->|H]; [left; now left | discriminate].
    - destruct H as [->|H]; [left; now left|]. injection H as ->. right; intros j J D; eapply meets_none; eauto.
    - destruct H as [->|H]; [left; right; cbn; now rewrite S | discriminate].
  Qed.

  Lemma apart_step : forall w e w', apart w -> leads w e w' -> apart w'.
  Proof.
    intros w e w' A L i j v I J Hi Hj. destruct (Nat.eq_dec i j) as [|D]; [assumption|exfalso].
    pose proof (step_turns w e w' L i I) as Ti; pose proof (step_turns w e w' L j J) as Tj.
    destruct (turns_hold _ _ _ _ _ Ti Hi) as [Bi|Ni], (turns_hold _ _ _ _ _ Tj Hj) as [Bj|Nj].
    - apply D; eapply A; eauto.
    - now apply (Nj i I D).
    - now apply (Ni j J (not_eq_sym D)).
    - destruct (turns_one _ _ _ _ _ _ Ti Tj D) as [E|E]; rewrite E in *; [now apply (Nj i I D) | now apply (Ni j J (not_eq_sym D))].
  Qed.

  Lemma apart_start : forall cells start w, may_start V cells obstacle N start -> alike V N (begins V N start) w -> apart w.
  Proof.
    intros cells start w [_ O] [A _] i j v I J Hi Hj. unfold holds, body in Hi, Hj; rewrite <- A in Hi, Hj by assumption.
    cbn in Hi, Hj; destruct Hi as [->|Hi]; [|discriminate]; destruct Hj as [Hj|Hj]; [|discriminate]. now apply O.
  Qed.
End Area.

(** Two robots are never in one cell, and none is in a cell that another one enters. *)
Theorem FRONTIER_2 : forall (V : Type) (same : V -> V -> bool) (cells : list V) (obstacle : V -> bool) (N : nat) (rl : rule V),
  (forall a b, same a b = true <-> a = b) -> forall w, run V same cells obstacle N rl w ->
  forall i j, i < N -> j < N -> i <> j ->
  place (robots w i) <> place (robots w j)
  /\ forall v, doing (robots w i) = Enters v -> v <> place (robots w j) /\ doing (robots w j) <> Enters v.
Proof.
  intros V same cells obstacle N rl S w R i j I J D.
  assert (apart V N w) as A.
  { induction R as [start w M A|w e w' R IH L]; [eapply apart_start; eauto | eapply apart_step; eauto]. }
  split.
  - intros E; apply D, (A i j (place (robots w i)) I J); [now left | left; exact E].
  - intros v Ei; split; [intros -> | intros Ej]; apply D; eapply A; eauto; try (right; cbn; eassumption); now left.
Qed.
