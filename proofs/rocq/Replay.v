(** Runs as data: a checker that computes, and that accepts nothing but runs of Team.v. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team.
Import ListNotations.

Record listed := { places : list cell; opened : list edge; made_so_far : list (list step) }.
Inductive team_move := Advance (steps : list step) | Backtrack (steps : list step).

Definition step_eqb (a b : step) : bool :=
  match a, b with
  | Stay, Stay | Cross East, Cross East | Cross South, Cross South | Cross West, Cross West | Cross North,
    Cross North => true
  | _, _ => false
  end.

Fixpoint list_eqb {A : Type} (eqb : A -> A -> bool) (l m : list A) : bool :=
  match l, m with
  | [], [] => true
  | a :: l, b :: m => eqb a b && list_eqb eqb l m
  | _, _ => false
  end.

Section Replay.
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable walls : list edge.

  Definition has (l : list edge) (e : edge) : bool := existsb (edge_eqb e) l.
  Arguments has : simpl never.
  Definition add (l : list edge) (e : edge) : list edge := if has l e then l else e :: l.
  Definition stands : edge -> bool := has walls.

  Definition team_of (l : list cell) : team := fun i => nth i l (0, 0)%Z.
  Definition plan_of (l : list step) : plan := fun i => nth i l Stay.
  Definition state_of (s : listed) : state :=
    {| pos := team_of (places s); open := has (opened s); log := map plan_of (made_so_far s) |}.

  Definition tabulate {A : Type} (f : nat -> A) : list A := map f (seq 0 N).

  Definition crossed (p : team) (pl : plan) : list edge :=
    flat_map (fun i => match pl i with Cross s => [edge_of (p i) s] | Stay => [] end) (seq 0 N).

  Definition list_advance (s : listed) (steps : list step) : listed :=
    let p := team_of (places s) in
    let m := tabulate (made stands p (plan_of steps)) in
    {| places := tabulate (fun i => after (p i) (nth i m Stay));
       opened := fold_left add (crossed p (plan_of m)) (opened s);
       made_so_far := m :: made_so_far s |}.

  Definition list_backtrack (s : listed) (pl : list step) (rest : list (list step)) : listed :=
    {| places := tabulate (moved stands (team_of (places s)) (undo (plan_of pl))); opened := opened s;
      made_so_far := rest |}.

  (** One team move, if it is one, and the team is then where it is said to be. *)
  Definition next (s : listed) (m : team_move) : option listed :=
    match m with
    | Advance steps => if admitted N rl base (state_of s) (plan_of steps) then Some (list_advance s steps) else None
    | Backtrack steps =>
        match made_so_far s with
        | pl :: rest => if list_eqb step_eqb steps (tabulate (undo (plan_of pl))) then Some (list_backtrack s pl rest)
          else None
        | [] => None
        end
    end.

  Fixpoint replay (s : listed) (story : list (team_move * list cell)) : option listed :=
    match story with
    | [] => Some s
    | (m, cells) :: story =>
        match next s m with
        | Some s' => if list_eqb cell_eqb (places s') cells then replay s' story else None
        | None => None
        end
    end.

  Definition list_start : listed := {| places := repeat base N; opened := []; made_so_far := [] |}.

  Lemma nth_tabulate : forall (A : Type) (f : nat -> A) d i, i < N -> nth i (tabulate f) d = f i.
  Proof.
    intros A f d i L; unfold tabulate. rewrite nth_indep with (d' := f 0) by (now rewrite map_length, seq_length).
    rewrite map_nth with (d := 0). now rewrite seq_nth.
  Qed.

  Lemma has_add : forall l e e', has (add l e) e' = edge_eqb e' e || has l e'.
  Proof.
    intros l e e'; unfold add; destruct (has l e) eqn:H; [|reflexivity].
    destruct (edge_eqb e' e) eqn:E; [|reflexivity].
    apply edge_eqb_spec in E; subst; now rewrite H.
  Qed.

  Lemma has_fold : forall more l e, has (fold_left add more l) e = has l e || has more e.
  Proof.
    intros more; induction more as [|a more IH]; intros l e; [unfold has; cbn; now rewrite orb_false_r|].
    change (fold_left add (a :: more) l) with (fold_left add more (add l a)).
    change (has (a :: more) e) with (edge_eqb e a || has more e).
    rewrite IH, has_add. now destruct (edge_eqb e a), (has l e), (has more e).
  Qed.

  Lemma edge_eqb_sym : forall a b, edge_eqb a b = edge_eqb b a.
  Proof.
    intros a b; destruct (edge_eqb a b) eqn:E, (edge_eqb b a) eqn:F; auto.
    - apply edge_eqb_spec in E; subst. symmetry; rewrite <- F; now apply edge_eqb_spec.
    - apply edge_eqb_spec in F; subst. rewrite <- E; now apply edge_eqb_spec.
  Qed.

  Lemma has_crossed : forall p pl e, has (crossed p pl) e = some N (crosses p pl e).
  Proof.
    intros p pl e; unfold crossed, some, has; induction (seq 0 N) as [|i l IH]; cbn; [reflexivity|].
    rewrite existsb_app, IH; f_equal. unfold crosses; destruct (pl i); cbn; [rewrite orb_false_r;
      apply edge_eqb_sym | reflexivity].
  Qed.

  Lemma same_plan_refl : forall l, Forall2 (same_plan N) l l.
  Proof. intros l; induction l; constructor; auto. intros i _; reflexivity. Qed.

  Lemma some_ext : forall n f g, (forall i, i < n -> f i = g i) -> some n f = some n g.
  Proof.
    intros n f g H; destruct (some n f) eqn:E; symmetry.
    - apply some_spec in E; destruct E as [i [L E]]; apply some_spec; exists i; split; auto; now rewrite <- H.
    - destruct (some n g) eqn:F; [|reflexivity]. apply some_spec in F; destruct F as [i [L F]].
      rewrite <- E; symmetry; apply some_spec; exists i; split; auto; now rewrite H.
  Qed.

  Lemma alike_advance : forall s steps,
    alike N (advance N stands (state_of s) (plan_of steps)) (state_of (list_advance s steps)).
  Proof.
    intros s steps; split; [|split]; cbn.
    - intros i L; cbn; unfold team_of at 2; rewrite !nth_tabulate by exact L. reflexivity.
    - intros e; rewrite has_fold, has_crossed; f_equal. apply some_ext; intros i L; unfold crosses.
      unfold plan_of at 2; now rewrite nth_tabulate by exact L.
    - constructor; [|apply same_plan_refl]. intros i L; unfold plan_of at 2; now rewrite nth_tabulate.
  Qed.

  Lemma alike_backtrack : forall s pl rest,
    alike N (backtrack stands (state_of s) (plan_of pl) (map plan_of rest)) (state_of (list_backtrack s pl rest)).
  Proof.
    intros s pl rest; split; [|split]; cbn.
    - intros i L; cbn; unfold team_of at 2; now rewrite nth_tabulate.
    - reflexivity.
    - apply same_plan_refl.
  Qed.

  Lemma alike_start : alike N (start base) (state_of list_start).
  Proof.
    split; [|split]; cbn.
    - intros i L; cbn; unfold team_of. rewrite nth_indep with (d' :=
        base) by (now rewrite repeat_length). now rewrite nth_repeat.
    - reflexivity.
    - constructor.
  Qed.

  Lemma next_reachable : forall s m s', reachable N rl base stands (state_of s) -> next s m = Some s' ->
    reachable N rl base stands (state_of s').
  Proof.
    intros s m s' [past R] E; unfold next in E; destruct m as [steps|steps].
    - destruct (admitted N rl base (state_of s) (plan_of steps)) eqn:A; [|discriminate]; injection E as <-.
      eexists; eapply run_advance; [exact R | exact A | apply alike_advance].
    - destruct (made_so_far s) as [|pl rest] eqn:G; [discriminate|].
      destruct (list_eqb _ _ _); [|discriminate]; injection E as <-.
      eexists; eapply run_backtrack; [exact R | cbn; rewrite G; reflexivity | apply alike_backtrack].
  Qed.

  Theorem replay_reachable : forall story s', replay list_start story = Some s' ->
    reachable N rl base stands (state_of s').
  Proof.
    assert (forall story s s', reachable N rl base stands (state_of s) -> replay s story = Some s' ->
      reachable N rl base stands (state_of s')) as G.
    { intros story; induction story as [|[m cells] story IH]; intros s s' R E; cbn in E; [now injection E as <-|].
      destruct (next s m) as [t|] eqn:X; [|discriminate]. destruct (list_eqb _ _ _); [|discriminate].
      eapply IH; [|exact E]. eapply next_reachable; eauto. }
    intros story s' E; eapply G; [|exact E]. eexists; apply run_start, alike_start.
  Qed.
End Replay.
