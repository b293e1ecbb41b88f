(** Local rules: a finite check implies an invariant for every number of robots, every layout and every run.

    A robot is in a cell and in a state. A layout gives each cell a colour. A rule says which acts there are, where
    each leads, what may come of it, and which plans of [k] robots it admits. It sees the [k] robots from the cell of
    the first one, so it is the same everywhere. Whether a robot goes, and in which state it is then, the world picks
    for each robot: walls, faults and late robots are reasons among others. The rule speaks of a set of [k]-tuples of
    robots, any set: neighbours in a chain or in a graph, all pairs, all triples. The team may go back to any earlier
    team at any time.

    [every_N] is the theorem. Its hypothesis [inductive] speaks of [k] robots of which the first is in the origin;
    [check_inductive] decides it by enumeration. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice.
Import ListNotations.
Local Open Scope Z_scope.

(** The offset of [c] from [v], and the cell at offset [d] from [c]. *)
Definition minus_cell (v c : cell) : cell := (fst c - fst v, snd c - snd v).
Definition plus_cell (c d : cell) : cell := (fst c + fst d, snd c + snd d).
(** At most [r] columns and [r] rows from the origin; all such cells, column by column. *)
Definition within (r : Z) (c : cell) : bool := if Z.abs (fst c) <=? r then Z.abs (snd c) <=? r else false.
Definition span (r : Z) : list Z := map (fun n => Z.of_nat n - r) (seq 0 (Z.to_nat (2 * r + 1))).
Definition box (r : Z) : list cell := flat_map (fun x => map (pair x) (span r)) (span r).

Lemma within_abs : forall r c, within r c = true <-> Z.abs (fst c) <= r /\ Z.abs (snd c) <= r.
Proof.
  intros r c; unfold within; destruct (Z.abs (fst c) <=? r) eqn:E.
  - apply Z.leb_le in E; rewrite Z.leb_le; tauto.
  - apply Z.leb_gt in E; split; [discriminate | lia].
Qed.

Lemma in_span : forall r z, Z.abs z <= r -> In z (span r).
Proof.
  intros r z A; unfold span; apply in_map_iff; exists (Z.to_nat (z + r)); split; [lia|].
  apply in_seq; lia.
Qed.

Lemma in_box : forall r c, within r c = true -> In c (box r).
Proof.
  intros r [x y] W; apply within_abs in W; cbn in W; apply in_flat_map; exists x; split; [now apply in_span|].
  now apply in_map, in_span.
Qed.

Lemma minus_minus : forall u v c, minus_cell (minus_cell v u) (minus_cell v c) = minus_cell u c.
Proof. intros [] [] []; unfold minus_cell; cbn; f_equal; lia. Qed.

Lemma cell_eqb_from : forall v c d, cell_eqb (minus_cell v c) (minus_cell v d) = cell_eqb c d.
Proof.
  intros v c d; apply eq_iff_eq_true; unfold cell_eqb, minus_cell; cbn; rewrite !andb_true_iff, !Z.eqb_eq; lia.
Qed.

Section Local.
  Variables (St Act Colour : Type) (same_colour : Colour -> Colour -> bool).
  Hypothesis colour_same : forall c, same_colour c c = true.
  (** How an act changes the cell, and what may come of it: whether the robot goes, and its next state. *)
  Variables (leads : St -> Act -> Z * Z) (ends : St -> Act -> list (bool * St)).

  (** A robot as others see it: its cell, its state, and the colour of its cell. *)
  Record now := { at_ : cell; is_ : St; on : Colour }.
  (** A robot and its plan: what it does, and the colour of the cell where that leads. *)
  Record plan := { own : now; does : Act; aims : Colour }.
  (** A plan, and what comes of it. *)
  Definition item : Type := plan * (bool * St).

  Definition goal (p : plan) : cell := plus_cell (at_ (own p)) (leads (is_ (own p)) (does p)).
  Definition next (x : item) : now :=
    let (p, o) := x in
    if fst o then {| at_ := goal p; is_ := snd o; on := aims p |}
    else {| at_ := at_ (own p); is_ := snd o; on := on (own p) |}.

  (** The number of robots in a tuple; which plans of them the rule admits; what is kept of them while all of them are
      within [reach] of the first one; and whether a tuple that is not so counts as kept. *)
  Variables (k : nat) (admits : list plan -> bool) (good : list now -> bool) (reach : Z) (far : bool).

  Definition seen_from (v : cell) (n : now) : now := {| at_ := minus_cell v (at_ n); is_ := is_ n; on := on n |}.
  Definition plan_from (v : cell) (p : plan) : plan :=
    {| own := seen_from v (own p); does := does p; aims := aims p |}.
  Definition item_from (v : cell) (x : item) : item := (plan_from v (fst x), snd x).

  Definition first (l : list now) : cell := match l with n :: _ => at_ n | [] => (0, 0) end.
  Definition rel (l : list now) : list now := map (seen_from (first l)) l.
  Definition rel_plans (l : list plan) : list plan := map (plan_from (first (map own l))) l.
  Definition near (l : list now) : bool := forallb (fun n => within reach (at_ n)) l.

  (** The invariant of a tuple, and whether its plans are admitted, both seen from its first robot. *)
  Definition inv (l : list now) : bool := if near (rel l) then good (rel l) else far.
  Definition admitted (l : list plan) : bool := admits (rel_plans l).

  (** Two robots that look at one cell see one colour. *)
  Definition agree_at (c : cell) (a : Colour) (d : cell) (b : Colour) : bool :=
    if cell_eqb c d then same_colour a b else true.
  Definition agree (p q : plan) : bool :=
    if agree_at (at_ (own p)) (on (own p)) (at_ (own q)) (on (own q)) then
    if agree_at (at_ (own p)) (on (own p)) (goal q) (aims q) then
    if agree_at (goal p) (aims p) (at_ (own q)) (on (own q)) then agree_at (goal p) (aims p) (goal q) (aims q)
    else false else false else false.

  (** * Teams *)

  Definition team := nat -> cell * St.

  Section Layout.
    (** The number of robots, the colours of the cells, the tuples of which the rule speaks, and the starts. *)
    Variables (N : nat) (layout : cell -> Colour) (bound : list nat -> Prop) (start : team -> Prop).

    Definition sees (t : team) (i : nat) : now :=
      {| at_ := fst (t i); is_ := snd (t i); on := layout (fst (t i)) |}.
    Definition plans (t : team) (a : nat -> Act) (i : nat) : plan :=
      {| own := sees t i; does := a i; aims := layout (plus_cell (fst (t i)) (leads (snd (t i)) (a i))) |}.
    Definition moved (t : team) (a : nat -> Act) (o : nat -> bool * St) : team := fun i =>
      (if fst (o i) then plus_cell (fst (t i)) (leads (snd (t i)) (a i)) else fst (t i), snd (o i)).

    Definition Inv (t : team) : Prop := forall is, bound is -> inv (map (sees t) is) = true.
    Definition team_admits (t : team) (a : nat -> Act) : Prop :=
      forall is, bound is -> admitted (map (plans t a) is) = true.

    (** Runs, with all that was before. *)
    Inductive run : list team -> team -> Prop :=
    | run_start : forall t, start t -> run [t] t
    | run_move : forall past t a o, run past t -> team_admits t a ->
        (forall i, (i < N)%nat -> In (o i) (ends (snd (t i)) (a i))) -> run (moved t a o :: past) (moved t a o)
    | run_back : forall past t q, run past t -> In q past -> run (q :: past) q.
  End Layout.

  (** * The same from everywhere *)

  Lemma goal_from : forall v p, goal (plan_from v p) = minus_cell v (goal p).
  Proof. intros [] [[[] s i] a j]; unfold goal, plus_cell, minus_cell; cbn; f_equal; lia. Qed.

  Lemma next_from : forall v x, next (item_from v x) = seen_from v (next x).
  Proof. intros v [p [[] s]]; cbn -[goal]; rewrite ?goal_from; reflexivity. Qed.

  Lemma rel_from : forall v l, rel (map (seen_from v) l) = rel l.
  Proof.
    intros v [|n r]; [reflexivity|]; unfold rel; rewrite map_map; cbn [first map at_ seen_from].
    f_equal; [|apply map_ext; intros m]; unfold seen_from; cbn; now rewrite minus_minus.
  Qed.

  Lemma inv_from : forall v l, inv (map (seen_from v) l) = inv l.
  Proof. intros v l; unfold inv; now rewrite rel_from. Qed.

  Lemma admitted_from : forall v l, admitted (map (plan_from v) l) = admitted l.
  Proof.
    intros v [|p r]; [reflexivity|]; unfold admitted, rel_plans; rewrite !map_map.
    cbn [first map at_ own seen_from plan_from].
    f_equal; f_equal; [|apply map_ext; intros q]; unfold plan_from, seen_from; cbn; now rewrite minus_minus.
  Qed.

  Lemma agree_from : forall v p q, agree (plan_from v p) (plan_from v q) = agree p q.
  Proof. intros v p q; unfold agree, agree_at; rewrite !goal_from; cbn; now rewrite !cell_eqb_from. Qed.

  (** * From [k] robots to every number *)

  (** The colours that cells may have. *)
  Variable colours : list Colour.

  (** What is true of every tuple of robots in a layout. *)
  Definition real (l : list item) : Prop :=
    Forall (fun x => In (snd x) (ends (is_ (own (fst x))) (does (fst x)))
      /\ In (on (own (fst x))) colours /\ In (aims (fst x)) colours) l
    /\ forall x y, In x l -> In y l -> agree (fst x) (fst y) = true.

  (** No admitted move of [k] robots, the first one in the origin, leaves the invariant. *)
  Definition inductive : Prop := forall h r, S (length r) = k -> at_ (own (fst h)) = (0, 0) -> real (h :: r) ->
    inv (map (fun x => own (fst x)) (h :: r)) = true -> admitted (map fst (h :: r)) = true ->
    inv (map next (h :: r)) = true.

  Hypothesis some_robots : k <> O.

  Lemma inductive_anywhere : inductive -> forall l, length l = k -> real l ->
    inv (map (fun x => own (fst x)) l) = true -> admitted (map fst l) = true -> inv (map next l) = true.
  Proof.
    intros K [|h r] L [F A] I D; [cbn in L; congruence|].
    set (v := at_ (own (fst h))).
    assert (forall l, map (fun x => own (fst x)) (map (item_from v) l)
      = map (seen_from v) (map (fun x : item => own (fst x)) l)) as E1 by (intros; now rewrite !map_map).
    assert (forall l, map fst (map (item_from v) l) = map (plan_from v) (map fst l)) as E2
      by (intros; now rewrite !map_map).
    assert (forall l, map next (map (item_from v) l) = map (seen_from v) (map next l)) as E3
      by (intros; rewrite !map_map; apply map_ext; intros; apply next_from).
    rewrite <- (inv_from v), <- E3; cbn [map]; apply K.
    - now rewrite map_length.
    - unfold v; destruct h as [[[[] s i] a j] o]; cbn; unfold minus_cell; cbn; now rewrite !Z.sub_diag.
    - change (item_from v h :: map (item_from v) r) with (map (item_from v) (h :: r)); split.
      + apply Forall_forall; intros x Ix; apply in_map_iff in Ix; destruct Ix as [y [<- Iy]].
        rewrite Forall_forall in F; exact (F y Iy).
      + intros x y Ix Iy; apply in_map_iff in Ix, Iy; destruct Ix as [x' [<- Ix]], Iy as [y' [<- Iy]].
        cbn [fst item_from]; rewrite agree_from; now apply A.
    - change (item_from v h :: map (item_from v) r) with (map (item_from v) (h :: r)); now rewrite E1, inv_from.
    - change (item_from v h :: map (item_from v) r) with (map (item_from v) (h :: r)); now rewrite E2, admitted_from.
  Qed.

  Section Sound.
    Variables (N : nat) (layout : cell -> Colour) (bound : list nat -> Prop) (start : team -> Prop).
    Hypothesis layout_colours : forall c, In (layout c) colours.
    Hypothesis bound_robots : forall is, bound is -> length is = k /\ Forall (fun i => i < N)%nat is.

    Lemma agree_plans : forall t a i j, agree (plans layout t a i) (plans layout t a j) = true.
    Proof.
      intros t a i j; unfold agree, agree_at, goal, plans, sees; cbn [own at_ is_ on does aims].
      assert (forall c d, (if cell_eqb c d then same_colour (layout c) (layout d) else true) = true) as E.
      { intros c d; destruct (cell_eqb c d) eqn:E; [|reflexivity].
        apply cell_eqb_spec in E; subst; apply colour_same. }
      now rewrite !E.
    Qed.

    (** One team move. *)
    Theorem move_keeps : inductive -> forall t a o, Inv layout bound t -> team_admits layout bound t a ->
      (forall i, (i < N)%nat -> In (o i) (ends (snd (t i)) (a i))) -> Inv layout bound (moved t a o).
    Proof.
      intros K t a o I A O is B; set (f := fun i => (plans layout t a i, o i) : item).
      destruct (bound_robots is B) as [L M]; rewrite Forall_forall in M.
      replace (map (sees layout (moved t a o)) is) with (map next (map f is)).
      - apply inductive_anywhere; [exact K | rewrite map_length; auto | split | |]; rewrite ?map_map.
        + apply Forall_forall; intros x Ix; apply in_map_iff in Ix; destruct Ix as [i [<- Ii]].
          repeat split; [apply O, M, Ii | apply layout_colours | apply layout_colours].
        + intros x y Ix Iy; apply in_map_iff in Ix, Iy; destruct Ix as [i [<- _]], Iy as [j [<- _]]; apply agree_plans.
        + exact (I is B).
        + exact (A is B).
      - rewrite map_map; apply map_ext; intros i; unfold f, next, sees, moved; cbn; destruct (o i) as [[] s];
          reflexivity.
    Qed.

    (** Every run. *)
    Theorem every_N : inductive -> (forall t, start t -> Inv layout bound t) ->
      forall past t, run N layout bound start past t -> Inv layout bound t.
    Proof.
      intros K G past t R; enough (Inv layout bound t /\ Forall (Inv layout bound) past) by tauto.
      induction R as [t B | past t a o R [I F] A O | past t q R [I F] Q]; [auto | |].
      - pose proof (move_keeps K t a o I A O); auto.
      - rewrite Forall_forall in F; split; [auto|]; constructor; [auto | now apply Forall_forall].
    Qed.
  End Sound.

  (** * The check by enumeration *)

  Section Enumeration.
    (** All states and acts, and how far an act leads at most. *)
    Variables (states : list St) (acts : list Act) (pace : Z).

    Fixpoint all_agree (l : list plan) : bool :=
      match l with [] => true | p :: r => if forallb (agree p) l then all_agree r else false end.

    (** One case: [k] robots, their plans, and what came of them. *)
    Definition case (l : list item) : bool :=
      if all_agree (map fst l) then
      if inv (map (fun x => own (fst x)) l) then
      if admitted (map fst l) then inv (map next l) else true else true else true.

    (** Every robot in one of [cells]; those that matter beside the first robot [h]; every tuple of them. *)
    Definition items (cells : list cell) : list item :=
      flat_map (fun c => flat_map (fun s => flat_map (fun a => flat_map (fun o => flat_map (fun i => map (fun j =>
        ({| own := {| at_ := c; is_ := s; on := i |}; does := a; aims := j |}, o)) colours) colours)
        (ends s a)) acts) states) cells.
    Definition matters (h x : item) : bool :=
      if agree (fst h) (fst x)
      then within reach (if far then minus_cell (at_ (next h)) (at_ (next x))
                         else minus_cell (at_ (own (fst h))) (at_ (own (fst x))))
      else false.
    Fixpoint tuples (n : nat) (xs : list item) (p : list item -> bool) : bool :=
      match n with O => p [] | S n => forallb (fun x => tuples n xs (fun r => p (x :: r))) xs end.

    Definition slow : bool := forallb (fun s => forallb (fun a => within pace (leads s a)) acts) states.
    Definition check : bool :=
      slow && let others := items (box (if far then reach + 2 * pace else reach)) in
      forallb (fun h => tuples (pred k) (filter (matters h) others) (fun r => case (h :: r))) (items [(0, 0)]).

    Hypothesis listed : forall s a o, In o (ends s a) -> In s states /\ In a acts.

    Lemma tuples_all : forall n xs p, tuples n xs p = true ->
      forall r, length r = n -> Forall (fun x => In x xs) r -> p r = true.
    Proof.
      induction n as [|n IH]; intros xs p T r L F.
      - destruct r; [exact T | discriminate].
      - destruct r as [|x r]; [discriminate|]; inversion F; subst; cbn in T; rewrite forallb_forall in T.
        apply (IH xs (fun r => p (x :: r))); auto.
    Qed.

    Lemma in_items : forall cells x, In (at_ (own (fst x))) cells ->
      In (snd x) (ends (is_ (own (fst x))) (does (fst x))) -> In (on (own (fst x))) colours ->
      In (aims (fst x)) colours -> In x (items cells).
    Proof.
      intros cells [[[c s i] a j] o] B O I J; cbn in *; unfold items; destruct (listed s a o O).
      apply in_flat_map; exists c; split; [exact B|]. apply in_flat_map; exists s; split; [auto|].
      apply in_flat_map; exists a; split; [auto|]. apply in_flat_map; exists o; split; [exact O|].
      apply in_flat_map; exists i; split; [auto|]. apply in_map_iff; exists j; auto.
    Qed.

    Lemma all_agree_real : forall l, (forall p q, In p l -> In q l -> agree p q = true) -> all_agree l = true.
    Proof.
      induction l as [|p r IH]; intros A; [reflexivity|]; cbn [all_agree].
      replace (forallb (agree p) (p :: r)) with true.
      - apply IH; intros; apply A; cbn; auto.
      - symmetry; apply forallb_forall; intros q I; apply A; cbn; auto.
    Qed.

    Lemma near_first : forall n l, near (rel (n :: l)) = true ->
      forall m, In m l -> within reach (minus_cell (at_ n) (at_ m)) = true.
    Proof.
      intros n l E m I; unfold near, rel in E; cbn [map first] in E; rewrite forallb_forall in E.
      apply (E (seen_from (at_ n) m)); right; now apply in_map.
    Qed.

    Theorem check_inductive : check = true -> inductive.
    Proof.
      intros K h r L O [F A] I D; unfold check in K; apply andb_true_iff in K; destruct K as [Sl K].
      rewrite forallb_forall in K.
      assert (In h (items [(0, 0)])) as H
        by (pose proof (Forall_inv F) as [? [? ?]]; apply in_items; auto; rewrite O; cbn; auto).
      specialize (K h H); pose proof (Forall_inv_tail F) as Fr; set (others := items _) in K.
      assert ((forall x, In x r -> within reach (if far then minus_cell (at_ (next h)) (at_ (next x))
        else minus_cell (at_ (own (fst h))) (at_ (own (fst x)))) = true) -> inv (map next (h :: r)) = true) as G.
      { intros W; assert (case (h :: r) = true) as C.
        { apply (tuples_all _ _ _ K r); [now rewrite <- L|]. apply Forall_forall; intros x Ix.
          rewrite Forall_forall in Fr; destruct (Fr x Ix) as [? [? ?]]; apply filter_In; split.
          - apply in_items; auto; apply in_box; specialize (W x Ix); destruct far.
            + apply within_abs; apply within_abs in W; unfold slow in Sl; rewrite forallb_forall in Sl.
              destruct h as [[[ch sh ih] ah jh] [gh sh']], x as [[[cx sx ix] ax jx] [gx sx']]; cbn in O; subst ch.
              pose proof (Forall_inv F) as [Oh _]; destruct (Fr _ Ix) as [Ox _]; cbn in Oh, Ox.
              destruct (listed _ _ _ Oh) as [Ish Iah], (listed _ _ _ Ox) as [Isx Iax].
              pose proof (Sl sh Ish) as S1; pose proof (Sl sx Isx) as S2.
              rewrite forallb_forall in S1, S2; specialize (S1 ah Iah); specialize (S2 ax Iax).
              apply within_abs in S1, S2; unfold next, goal, plus_cell, minus_cell in *; destruct gh, gx;
                cbn [fst snd at_ own is_ does] in *; lia.
            + rewrite O in W; unfold minus_cell in W; cbn in W; rewrite !Z.sub_0_r in W.
              destruct (at_ (own (fst x))); exact W.
          - unfold matters; rewrite (A h x) by (cbn; auto); now apply W. }
        unfold case in C; rewrite all_agree_real, I, D in C; [exact C|].
        intros p q Ip Iq; apply in_map_iff in Ip, Iq; destruct Ip as [x [<- Ix]], Iq as [y [<- Iy]]; now apply A. }
      destruct (bool_dec far true) as [Fa|Fa].
      - unfold inv; destruct (near (rel (map next (h :: r)))) eqn:Ne; [|exact Fa].
        assert (inv (map next (h :: r)) = true) as E; [|unfold inv in E; now rewrite Ne in E].
        apply G; intros x Ix; rewrite Fa; cbn [map] in Ne; apply (near_first _ _ Ne); now apply in_map.
      - apply G; intros x Ix; apply not_true_is_false in Fa; rewrite Fa in *.
        unfold inv in I; destruct (near (rel (map _ (h :: r)))) eqn:Ne; [|rewrite Fa in I; discriminate].
        cbn [map] in Ne; apply (near_first _ _ Ne); now apply (in_map (fun x : item => own (fst x))).
    Qed.
  End Enumeration.
End Local.
