(** The tie between the kernel and Sides.v and Joint.v: the kernel's runs in generated/JointRuns.v are runs of the
    definitions. After each step the same sides count as covered for each robot; and wherever one of two robots decides, it may
    take the same old paths. Runs by rules that forget sides are runs with the marking that does so, and no others. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Kit KitTie Sides Joint.
From Tautline.generated Require Import JointRuns.
Import ListNotations.
Local Open Scope nat_scope.

(** Nodes row by row; the border and the paths that are blocked. *)
Definition nodes (columns rows : Z) : list cell :=
  flat_map (fun y => map (fun x => (Z.of_nat x, Z.of_nat y)) (seq 0 (Z.to_nat columns))) (seq 0 (Z.to_nat rows)).
Definition is_inside (columns rows : Z) (c : cell) : bool :=
  ((0 <=? fst c) && (fst c <? columns) && (0 <=? snd c) && (snd c <? rows))%Z.
Definition border_of (columns rows : Z) (e : edge) : bool :=
  negb (is_inside columns rows (fst e) && is_inside columns rows (beyond (fst e) (if snd e then East else South))).
Definition wall_of (columns rows : Z) (walls : list edge) (e : edge) : bool := border_of columns rows e || has_edge walls e.

Section Run.
  Variables (m : marking) (N : nat) (columns rows : Z) (walls : list edge).
  Variable may : world -> nat -> side -> bool.
  Variable of_part : world -> nat -> cell -> option (list side).
  Let border := border_of columns rows.
  Let wall := wall_of columns rows walls.

  (** The paths that robot [i] may drive again. *)
  Definition old_sides (w : world) (i : nat) : list side :=
    match stances w i with
    | Stands c => match of_part w i c with Some l => l | None => [] end
    | Drives _ _ => []
    end.
  Definition same_sides (l k : list side) : bool :=
    forallb (fun s => Bool.eqb (existsb (side_eqb s) l) (existsb (side_eqb s) k)) all_sides.
  Definition covered_sides (w : world) (i : nat) : list bool :=
    flat_map (fun c => map (covered N m border w i c) all_sides) (nodes columns rows).

  Fixpoint acts (w : world) (es : list event) : option world :=
    match es with
    | [] => Some w
    | e :: es => match act N m wall may w e with Some w => acts w es | None => None end
    end.
  Fixpoint replay (w : world) (steps : list (list event * option (nat * list side) * list BinNums.N)) : option world :=
    match steps with
    | [] => Some w
    | (es, old, bits) :: steps =>
        if match old with Some (i, l) => same_sides (old_sides w i) l | None => true end
        then match acts w es with
             | Some w => if forallb (fun '(i, b) => same_bits (covered_sides w i) b) (combine (seq 0 N) bits)
                         then replay w steps else None
             | None => None
             end
        else None
    end.

  Lemma acts_run : forall start es l w w', Sides.run N m wall may start l w -> acts w es = Some w' ->
    Sides.run N m wall may start (rev es ++ l) w'.
  Proof.
    intros start es; induction es as [|e es IH]; intros l w w' R A; cbn in A; [injection A as <-; exact R|].
    destruct (act N m wall may w e) as [x|] eqn:E; [|discriminate]. cbn; rewrite <- app_assoc; cbn. eapply IH; eauto.
    now apply run_goes_on with (w := w).
  Qed.
  Lemma replay_runs : forall start steps l w w', Sides.run N m wall may start l w -> replay w steps = Some w' ->
    exists k, Sides.run N m wall may start k w'.
  Proof.
    intros start steps; induction steps as [|[[es old] bits] steps IH]; intros l w w' R A; cbn [replay] in A.
    - injection A as <-; eauto.
    - destruct (match old with Some (i, l) => same_sides (old_sides w i) l | None => true end); [|discriminate].
      destruct (acts w es) as [x|] eqn:E; [|discriminate]. destruct (forallb _ _); [|discriminate].
      eapply IH; [eapply acts_run; [exact R | exact E] | exact A].
  Qed.
End Run.

Definition standing_at (starts : list cell) : team := fun i => Stands (nth i starts (0, 0)%Z).
Definition recorded : Type := (nat * Z * Z) * list edge * list cell * list (list event * option (nat * list side) * list BinNums.N).

(** Two robots start at different nodes in contact. *)
Definition may_start_at (columns rows : Z) (starts : list cell) : bool :=
  match starts with
  | [a; b] => existsb (cell_eqb a) (nodes columns rows) && existsb (cell_eqb b) (nodes columns rows)
              && in_reach a b && negb (cell_eqb a b)
  | _ => false
  end.
Definition two_agree (of_part : list cell -> (edge -> bool) -> world -> nat -> cell -> option (list side)) (r : recorded) : bool :=
  let '(n, columns, rows, walls, starts, steps) := r in
  (n =? 2) && may_start_at columns rows starts
  && match replay MARKED 2 columns rows walls (may (nodes columns rows) (border_of columns rows))
       (of_part (nodes columns rows) (border_of columns rows)) (begins (standing_at starts)) steps
     with Some _ => true | None => false end.
Definition agree_by (m : marking) (r : recorded) : bool :=
  let '(n, columns, rows, walls, starts, steps) := r in
  match replay m n columns rows walls anywhere (fun _ _ _ => None) (begins (standing_at starts)) (map (fun '(es, _, b) => (es, None, b)) steps)
  with Some _ => true | None => false end.

(** They are no runs of robots that go by the joint way alone. *)
Theorem joint_runs_agree :
  forallb (two_agree part) runs_two = true /\ forallb (two_agree joint_part) (firstn 8 runs_two) = false
  /\ forallb (agree_by MARKED) runs_three = true
  /\ forallb (agree_by without_Marked) runs_unmarked = true /\ forallb (agree_by MARKED) runs_unmarked = false
  /\ forallb (agree_by others_alone) runs_others = true /\ forallb (agree_by MARKED) runs_others = false.
Proof.
  split; [|split; [|split; [|split; [|split; [|split]]]]].
  1,3,4,6: vm_cast_no_check (eq_refl true).
  all: vm_cast_no_check (eq_refl false).
Qed.

Lemma may_start_starts : forall columns rows starts, may_start_at columns rows starts = true ->
  may_start (nodes columns rows) (standing_at starts).
Proof.
  intros columns rows [|a [|b [|]]] H; try discriminate. cbn [may_start_at] in H; rewrite !andb_true_iff in H.
  destruct H as [[[A B] R] D]; apply negb_true_iff in D.
  assert (forall c, existsb (cell_eqb c) (nodes columns rows) = true -> In c (nodes columns rows)) as X.
  { intros c E; apply existsb_exists in E; destruct E as [d [I E]]; apply cell_eqb_spec in E; now subst. }
  assert (forall i, standing_at [a; b] i = standing a b i \/ 2 <= i) as S by (intros [|[|i]]; [left | left | right; lia]; reflexivity).
  split; [|split].
  - intros [|[|i]] L; [exists a | exists b | lia]; split; try reflexivity; now apply X.
  - apply connected_two; unfold is_sure_of; cbn; now rewrite R.
  - intros [|[|i]] [|[|j]] Li Lj Dij; try lia; unfold is_apart_from, Kit.has; cbn; [rewrite (cell_eqb_sym a b) in D|]; now rewrite D.
Qed.

(** Each run of two robots of the kernel is a run that the theorems speak of. *)
Theorem kernel_runs_are_runs : forall n columns rows walls starts steps, In (n, columns, rows, walls, starts, steps) runs_two ->
  exists l w, two (nodes columns rows) (border_of columns rows) (wall_of columns rows walls) l w
  /\ replay MARKED 2 columns rows walls (may (nodes columns rows) (border_of columns rows))
       (part (nodes columns rows) (border_of columns rows)) (begins (standing_at starts)) steps = Some w.
Proof.
  intros n columns rows walls starts steps I. pose proof (proj1 joint_runs_agree) as A; rewrite forallb_forall in A.
  apply A in I; unfold two_agree in I; rewrite !andb_true_iff in I; destruct I as [[_ S] R].
  destruct (replay _ _ _ _ _ _ _ _ _) as [w|] eqn:E; [|discriminate].
  destruct (replay_runs _ _ _ _ _ _ _ (may_start (nodes columns rows)) _ _ _ _ (run_begins _ _ _ _ _ _ (may_start_starts _ _ _ S)) E)
    as [l L]. exists l, w; split; [exact L | reflexivity].
Qed.

(** No open path leads out of such an area. *)
Theorem areas_are_closed : forall columns rows walls c s, In c (nodes columns rows) ->
  wall_of columns rows walls (edge_of c s) = false -> In (beyond c s) (nodes columns rows).
Proof.
  intros columns rows walls c s _ W; unfold wall_of, border_of in W; apply orb_false_iff in W; destruct W as [W _].
  apply negb_false_iff, andb_true_iff in W. destruct W as [A B].
  assert (is_inside columns rows (beyond c s) = true) as I.
  { destruct s; cbn [edge_of fst snd] in *; [exact B | exact B | exact A | exact A]. }
  unfold is_inside in I; rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in I; destruct I as [[[X0 X1] Y0] Y1].
  unfold nodes; apply in_flat_map; exists (Z.to_nat (snd (beyond c s))); split; [apply in_seq; lia|].
  apply in_map_iff; exists (Z.to_nat (fst (beyond c s))); split; [|apply in_seq; lia].
  destruct (beyond c s) as [x y]; cbn [fst snd] in *; f_equal; lia.
Qed.
