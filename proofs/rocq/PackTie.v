(** The tie between the kernel and Pack.v: which cells have a link is what the kernel answers in generated/PackAnswers.v,
    and each of the kernel's runs there is one of the definitions: in each team move there is an order in which the steps
    of the robots are admitted. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Pack.
From Tautline Require KitTie.
From Tautline.generated Require Import PackAnswers.
Import ListNotations.

(** Columns and rows, row by row, as the kernel was asked. *)
Definition numbers : list Z := map (fun i => (Z.of_nat i - reach)%Z) (seq 0 (Z.to_nat (2 * reach + 1))).
Definition offsets : list cell := flat_map (fun y => map (fun x => (x, y)) numbers) numbers.
Definition links_agree (link : Z -> cell -> cell -> bool) (tables : list (Z * N)) : bool :=
  forallb (fun t => KitTie.same_bits (map (link (fst t) (0, 0)%Z) offsets) (snd t)) tables.

Section Replay.
  Variables (range : Z) (free : cell -> bool).
  Notation link := (links range).

  Definition at_ (l : list cell) : team := fun i => nth i l (0, 0)%Z.
  Definition is_in (k : nat) (l : list nat) : bool := existsb (Nat.eqb k) l.
  Definition robots (l : list cell) : list nat := seq 0 (length l).
  (** The robots that [turns] links in a row, or fewer, join to the first one. *)
  Fixpoint reached (l : list cell) (turns : nat) : list nat :=
    match turns with
    | O => [0]
    | S n => let r := reached l n in
        r ++ filter (fun k => negb (is_in k r) && existsb (fun j => link (at_ l j) (at_ l k)) r) (robots l)
    end.
  Definition is_connected (l : list cell) : bool := forallb (fun k => is_in k (reached l (length l))) (robots l).
  Definition moved (l : list cell) (i : nat) (c : cell) : list cell := map (put (at_ l) i c) (robots l).
  (** A robot takes a step, if it may. *)
  Definition step_by (l : list cell) (i : nat) (s : side) : option (list cell) :=
    let c := beyond (at_ l i) s in
    if (i <? length l) && free c && forallb (fun d => negb (cell_eqb d c)) l && is_connected (moved l i c) then Some (moved l i c) else None.
  (** Those of [order] take their steps, [gone] having taken theirs. *)
  Fixpoint in_order (gone order : list nat) (steps : list nat) (l : list cell) : option (list cell) :=
    match order with
    | [] => Some l
    | i :: order => match nth (nth i steps 4) all_steps Stay with
        | Stay => in_order gone order steps l
        | Cross s => match step_by l i s with
            | Some m => if is_in i gone then None else in_order (i :: gone) order steps m
            | None => None
            end
        end
    end.
  Fixpoint orders (l : list nat) : list (list nat) :=
    match l with
    | [] => [[]]
    | x :: l => flat_map (fun o => map (fun k => firstn k o ++ x :: skipn k o) (seq 0 (S (length o)))) (orders l)
    end.
  Definition in_some_order (steps : list nat) (l : list cell) : option (list cell) :=
    fold_left (fun found o => match found with Some m => Some m | None => in_order [] o steps l end) (orders (robots l)) None.

  (** Where the steps lead, whoever may take them. *)
  Definition all_after (l : list cell) (steps : list nat) : list cell :=
    map (fun p => after (fst p) (nth (snd p) all_steps Stay)) (combine l steps).
  Definition same_cells (l m : list cell) : bool :=
    (length l =? length m) && forallb (fun p => cell_eqb (fst p) (snd p)) (combine l m).
  Fixpoint replay (past : list (list cell)) (l : list cell) (moves : list (bool * list nat)) : option (list cell) :=
    match moves with
    | [] => Some l
    | (true, steps) :: moves => match past with
        | u :: past => if same_cells u (all_after l steps) then replay past u moves else None
        | [] => None
        end
    | (false, steps) :: moves => match in_some_order steps l with
        | Some m => if same_cells m (all_after l steps) then replay (l :: past) m moves else None
        | None => None
        end
    end.
  Definition may_start (l : list cell) : bool :=
    is_connected l && forallb free l && forallb (fun i => forallb (fun j => (i =? j) || negb (cell_eqb (at_ l i) (at_ l j))) (robots l)) (robots l).

  Lemma links_sym : forall a b, link a b = true -> link b a = true.
  Proof.
    intros [a1 a2] [b1 b2]; unfold links, corners; cbn [forallb fst snd]; rewrite !andb_true_iff, !Z.leb_le.
    intros [A [B [C [D _]]]]; repeat split; nia.
  Qed.
  Lemma joined_trans : forall N t i j k, joined link N t i j -> joined link N t j k -> joined link N t i k.
  Proof. intros N t i j k A B; induction B as [|m k B IH K L]; [exact A | eapply joined_over; eauto]. Qed.
  Lemma joined_back : forall N t i j, i < N -> joined link N t i j -> j < N /\ joined link N t j i.
  Proof.
    intros N t i j I J; induction J as [|j k J [L IH] K E]; [split; [exact I | apply joined_self]|]. split; [exact K|].
    eapply joined_trans; [|exact IH]. eapply joined_over; [apply joined_self | exact L | apply links_sym, E].
  Qed.
  Lemma reached_joined : forall l n k, In k (reached l n) -> joined link (length l) (at_ l) 0 k.
  Proof.
    intros l; induction n as [|n IH]; intros k I; cbn in I; [destruct I as [<-|[]]; apply joined_self|].
    apply in_app_or in I; destruct I as [I|I]; [auto|]. apply filter_In in I; destruct I as [K I].
    apply andb_true_iff in I; destruct I as [_ I]; apply existsb_exists in I; destruct I as [j [J E]].
    apply in_seq in K; apply joined_over with (j := j); [apply IH, J | lia | exact E].
  Qed.
  Lemma is_connected_spec : forall l, is_connected l = true -> connected link (length l) (at_ l).
  Proof.
    intros l C i j I J; unfold is_connected in C; rewrite forallb_forall in C.
    assert (forall k, k < length l -> joined link (length l) (at_ l) 0 k) as G.
    { intros k K; assert (In k (robots l)) as X by (apply in_seq; lia). apply C, existsb_exists in X; destruct X as [m [M E]].
      apply Nat.eqb_eq in E; subst m; now apply reached_joined in M. }
    eapply joined_trans; [apply joined_back; [|apply G; exact I]; lia | now apply G].
  Qed.
  Lemma moved_at : forall l i c j, j < length l -> at_ (moved l i c) j = put (at_ l) i c j.
  Proof.
    intros l i c j J; unfold at_ at 1, moved; rewrite nth_indep with (d' := put (at_ l) i c 0) by (unfold robots; now rewrite map_length, seq_length).
    unfold robots; rewrite map_nth, seq_nth by exact J; reflexivity.
  Qed.
  Lemma moved_length : forall l i c, length (moved l i c) = length l.
  Proof. intros; unfold moved, robots; now rewrite map_length, seq_length. Qed.
  Lemma in_order_goes : forall order gone steps t l m, goes link (length l) (fun c => free c = true) t gone (at_ l) ->
    in_order gone order steps l = Some m -> length m = length l /\ exists gone, goes link (length l) (fun c => free c = true) t gone (at_ m).
  Proof.
    induction order as [|i order IH]; intros gone steps t l m G E; cbn [in_order] in E; [injection E as <-; eauto|].
    destruct (nth _ all_steps Stay) as [s|]; [|eauto]. destruct (step_by l i s) as [x|] eqn:S; [|discriminate].
    destruct (is_in i gone) eqn:O; [discriminate|].
    unfold step_by in S; destruct (_ && _) eqn:C; [|discriminate]; injection S as <-.
    rewrite !andb_true_iff, Nat.ltb_lt, forallb_forall in C; destruct C as [[[I Y] F] C].
    apply is_connected_spec in C; rewrite moved_length in C.
    assert (goes link (length l) (fun c => free c = true) t (i :: gone) (at_ (moved l i (beyond (at_ l i) s)))) as G'.
    { eapply goes_on; [exact G | exact I | | exact Y | | | exact C].
      - intros X; rewrite <- not_true_iff_false in O; apply O, existsb_exists; exists i; split; [exact X | apply Nat.eqb_refl].
      - intros j J X; assert (In (at_ l j) l) as Z by now apply nth_In. apply F in Z; rewrite X in Z.
        apply negb_true_iff in Z; rewrite (proj2 (cell_eqb_spec _ _) eq_refl) in Z; discriminate.
      - intros j J; now apply moved_at. }
    specialize (IH (i :: gone) steps t (moved l i (beyond (at_ l i) s)) m); rewrite moved_length in IH; auto.
  Qed.
  Lemma in_some_order_goes : forall steps l m, in_some_order steps l = Some m ->
    length m = length l /\ exists gone, goes link (length l) (fun c => free c = true) (at_ l) gone (at_ m).
  Proof.
    intros steps l m; unfold in_some_order.
    assert (forall os found, (forall x, found = Some x -> length x = length l /\ exists gone, goes link (length l) (fun c => free c = true) (at_ l) gone (at_ x)) ->
      fold_left (fun found o => match found with Some m => Some m | None => in_order [] o steps l end) os found = Some m ->
      length m = length l /\ exists gone, goes link (length l) (fun c => free c = true) (at_ l) gone (at_ m)) as G.
    { induction os as [|o os IH]; intros found F E; cbn in E; [auto|]. eapply IH; [|exact E].
      intros x X; destruct found as [y|]; [auto|]. eapply in_order_goes; [apply goes_not | exact X]. }
    apply G; discriminate.
  Qed.
  Lemma replay_runs : forall moves past l m, Forall (fun u => length u = length l) past ->
    run (fun c => free c = true) link (length l) (map at_ past) (at_ l) -> replay past l moves = Some m ->
    length m = length l /\ exists past, run (fun c => free c = true) link (length l) past (at_ m).
  Proof.
    induction moves as [|[[] steps] moves IH]; intros past l m F R E; cbn in E; [injection E as <-; eauto| |].
    - destruct past as [|u past]; [discriminate|]. destruct (same_cells u _); [|discriminate].
      inversion F as [|x y Lu Fp]; subst. rewrite <- Lu in *; eapply IH; [| |exact E]; [exact Fp | eapply run_back; exact R].
    - destruct (in_some_order steps l) as [u|] eqn:O; [|discriminate]. destruct (same_cells u _); [|discriminate].
      apply in_some_order_goes in O; destruct O as [Lu [gone G]]; rewrite <- Lu in F, R, G |- *; eapply IH; [| |exact E].
      + constructor; [now symmetry | exact F].
      + cbn [map]; eapply run_move; [exact R | intros c K; exact K | exact G].
  Qed.
  Lemma may_start_runs : forall l, may_start l = true -> run (fun c => free c = true) link (length l) [] (at_ l).
  Proof.
    intros l S; unfold may_start in S; rewrite !andb_true_iff, !forallb_forall in S; destruct S as [[C F] S].
    apply run_start; [now apply is_connected_spec | | intros i I; now apply F, nth_In]. intros i j I J E.
    assert (In i (robots l)) as X by (apply in_seq; lia). apply S in X; rewrite forallb_forall in X.
    assert (In j (robots l)) as Y by (apply in_seq; lia). apply X in Y; apply orb_true_iff in Y; destruct Y as [Y|Y]; [now apply Nat.eqb_eq|].
    rewrite E, (proj2 (cell_eqb_spec _ _) eq_refl) in Y; discriminate.
  Qed.
End Replay.

Definition run_of_kernel : Type := Z * list cell * list cell * list (bool * list nat).
(** A floor: the cells from 0,0 on, without the obstacles. *)
Definition is_free (obstacles : list cell) (c : cell) : bool :=
  (0 <=? fst c)%Z && (fst c <? width)%Z && (0 <=? snd c)%Z && (snd c <? width)%Z && negb (existsb (cell_eqb c) obstacles).
(** Where the robots are at last by their steps. *)
Definition last_cells (r : run_of_kernel) : list cell :=
  let '(_, starts, _, moves) := r in fold_left (fun l m => all_after l (snd m)) moves starts.
Definition is_run (r : run_of_kernel) : bool :=
  let '(range, starts, obstacles, moves) := r in
  may_start range (is_free obstacles) starts && match replay range (is_free obstacles) [] starts moves with Some l => same_cells l (last_cells r) | None => false end.

(** The run with obstacles where its robots stand at last: it is none. *)
Definition barred (r : run_of_kernel) : run_of_kernel :=
  let '(range, starts, _, moves) := r in (range, starts, last_cells r, moves).

Theorem pack_answers_agree : links_agree links links_REPAIRED = true /\ links_agree links_published links_PUBLISHED = true
  /\ links_agree links links_PUBLISHED = false /\ forallb is_run runs = true /\ existsb is_run (map barred runs) = false.
Proof. repeat split; vm_compute; reflexivity. Qed.

Theorem kernel_runs_are_runs : forall range starts obstacles moves, In (range, starts, obstacles, moves) runs ->
  exists past t, run (fun c => is_free obstacles c = true) (links range) (length starts) past t
    /\ forall i, i < length starts -> t i = nth i (last_cells (range, starts, obstacles, moves)) (0, 0)%Z.
Proof.
  intros range starts obstacles moves I; destruct pack_answers_agree as [_ [_ [_ [A _]]]]; rewrite forallb_forall in A; apply A in I.
  unfold is_run in I; apply andb_true_iff in I; destruct I as [S I]; destruct (replay _ _ _ _ _) as [l|] eqn:E; [|discriminate].
  apply (replay_runs range _ moves [] starts l) in E; [|constructor | now apply may_start_runs]; destruct E as [L [past R]].
  exists past, (at_ l); split; [exact R|]. unfold same_cells in I; apply andb_true_iff in I; destruct I as [Ln I].
  apply Nat.eqb_eq in Ln; intros i Li.
  assert (forall (l m : list cell) i, length l = length m -> forallb (fun p => cell_eqb (fst p) (snd p)) (combine l m) = true ->
    nth i l (0, 0)%Z = nth i m (0, 0)%Z) as G.
  { clear; induction l as [|c l IH]; intros [|d m] i Ln F; try discriminate; [reflexivity|]; cbn in F.
    apply andb_true_iff in F; destruct F as [E F]; apply cell_eqb_spec in E; cbn in E; destruct i; [exact E|]; cbn.
    apply IH; [injection Ln; auto | exact F]. }
  now apply G.
Qed.
