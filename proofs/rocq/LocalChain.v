(** The chain's relation as a local rule: the finite check of Local.v, with the conditions of Rule.v. Contact holds not
    only along a chain: the pairs of neighbours may be those of any graph of robots, as long as each keeps the relation. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Local.
Import ListNotations.
Local Open Scope nat_scope.

(** An act is a step, and whether the side that it crosses is known to be open: a robot is sure to go there. *)
Definition act : Type := step * bool.
Definition acts : list act := list_prod all_steps [true; false].
Definition leads (_ : unit) (a : act) : Z * Z := match fst a with Cross s => offset s | Stay => (0, 0)%Z end.
Definition ends (_ : unit) (a : act) : list (bool * unit) :=
  match fst a, snd a with Cross _, false => [(true, tt); (false, tt)] | _, _ => [(true, tt)] end.

Definition move_of (p : Local.plan unit act unit) : move :=
  Build_move (at_ _ _ (own _ _ _ p)) (fst (Local.does _ _ _ p)) (snd (Local.does _ _ _ p)).
(** A plan of two neighbours, the one behind first. *)
Definition admits (r : rule) (l : list (Local.plan unit act unit)) : bool :=
  match map move_of l with
  | [own; ahead] => admits_ahead r own ahead
      && (match Rule.does ahead with Stay => true | _ => admits_behind r (to ahead) (from own) end)
  | _ => false
  end.
Definition in_contact (l : list (Local.now unit unit)) : bool :=
  match l with [a; b] => covers COVERED (at_ _ _ a) (at_ _ _ b) | _ => false end.
Definition check (r : rule) : bool :=
  Local.check unit act unit (fun _ _ => true) leads ends 2 (admits r) in_contact 2 false [tt] [tt] acts 1.

Lemma repaired_is_inductive : check REPAIRED = true.
Proof. vm_compute; reflexivity. Qed.
(** Each condition is needed: without it a move of two neighbours leaves contact. *)
Theorem each_condition_is_needed :
  map check [without_SafeAhead; without_CoveredBehind; without_UnsureAhead; PUBLISHED] = [false; false; false; false].
Proof. vm_compute; reflexivity. Qed.

Section Robots.
  Variables (N : nat) (neighbours : nat -> nat -> Prop).
  Hypothesis robots : forall i j, neighbours i j -> i < N /\ j < N.
  Definition pairs (is : list nat) : Prop := exists i j, neighbours i j /\ is = [i; j].
  (** All robots start in one cell. *)
  Definition together (t : Local.team unit) : Prop := forall i, fst (t i) = fst (t O).
  Definition run (r : rule) := Local.run unit act unit leads ends (admits r) N (fun _ => tt) pairs together.

  Theorem any_neighbours_keep_contact : forall past t, run REPAIRED past t ->
    forall i j, neighbours i j -> covers COVERED (fst (t i)) (fst (t j)) = true.
  Proof.
    intros past t R i j B.
    assert (Local.Inv unit unit in_contact 2 false (fun _ => tt) pairs t) as I.
    { eapply (Local.every_N unit act unit (fun _ _ => true)) with (colours := [tt]) (bound := pairs) (N := N) (k := 2);
        [reflexivity | discriminate | cbn; auto | | | | exact R].
      - intros is [x [y [P ->]]]; destruct (robots x y P); auto.
      - apply (Local.check_inductive unit act unit (fun _ _ => true)) with (states := [tt]) (acts := acts) (pace := 1%Z);
          [discriminate | intros [] [[[]|] []]; cbn; auto 20 | exact repaired_is_inductive].
      - intros s T is [x [y [_ ->]]]; unfold Local.inv, near, rel, in_contact; cbn [map first at_ seen_from forallb sees].
        rewrite (T x), (T y); destruct (fst (s O)) as [a b]; unfold minus_cell; cbn [fst snd]; rewrite !Z.sub_diag.
        reflexivity. }
    specialize (I [i; j] (ex_intro _ i (ex_intro _ j (conj B eq_refl)))).
    unfold Local.inv, near, rel, in_contact in I; cbn [map first at_ seen_from forallb sees] in I.
    destruct (within 2 _ && _) in I; [|discriminate].
    assert (forall r v a b, covers r (minus_cell v a) (minus_cell v b) = covers r a b) as E.
    { assert (forall a b v : Z, (a - v - (b - v) = a - b)%Z) as E by (intros; ring).
      intros r [] [] []; unfold covers, minus_cell; cbn [fst snd]; now rewrite !E. }
    rewrite E in I; exact I.
  Qed.
End Robots.
