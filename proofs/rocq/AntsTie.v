(** The tie between the kernel and Ants.v: where the kernel's ants go, and what the cell that they enter counts then, in
    generated/AntsAnswers.v, is what [run] allows; and the kernel's runs there, with walls and sensors that are missed,
    are runs of Ants.v. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Ants.
From Tautline.generated Require Import AntsAnswers.
Import ListNotations.

(** The neighbours of an ant's cell 0 in a question, 1 to 4 in the order of the compass: 0 stands for a wall, 1 to 3
    for a cell that was entered 0 to 2 times, 4 and 5 for one that was entered once or twice and whose sensor is
    missed. *)
Fixpoint questions (k : nat) : list (list nat) :=
  match k with O => [[]] | S k => flat_map (fun q => map (fun x => x :: q) (seq 0 6)) (questions k) end.
Definition neighbour (q : list nat) (x : nat) : nat := nth (pred x) q 0.
Definition asked_beside (q : list nat) (u : nat) : list nat := filter (fun x => negb (neighbour q x =? 0)) [1; 2; 3; 4].
Definition is_missed (q : list nat) (x : nat) : bool := 4 <=? neighbour q x.
Definition counted (q : list nat) (own x : nat) : nat :=
  match x with O => own | _ => if is_missed q x then neighbour q x - 3 else neighbour q x - 1 end.
Definition asked (q : list nat) (own : nat) : state nat := {| count := counted q own; at_ := fun _ => 0 |}.

(** The first of the least, and four times what the cell counts then: 0 if the ant stays. *)
Definition goes (r : rule) (own : nat) (q : list nat) : nat :=
  let read := reads nat (is_missed q) (asked q own) in
  match least nat read (asked_beside q 0) with
  | None => 0
  | Some v => v + 4 * count nat (enter nat Nat.eqb r (asked q own) 0 v (read v)) v
  end.

(** The ant's own cell counts 1, or 3. *)
Definition agrees (r : rule) (answers : list nat) : bool :=
  if list_eq_dec Nat.eq_dec (map (goes r 1) (questions 4) ++ map (goes r 3) (questions 4)) answers then true else false.

(** By the wrong rule [Once] the answers are others. *)
Theorem ants_answers_agree :
  agrees Lost answers_Lost && agrees Beside answers_Beside && agrees Counted answers_Counted
    && agrees Repaired answers_Repaired = true
  /\ existsb (agrees Once) [answers_Lost; answers_Beside; answers_Counted; answers_Repaired] = false.
Proof. split; vm_compute; reflexivity. Qed.

(** A floor of the lattice: its cells, and the walls between them. *)
Definition compass : list side := [North; East; South; West].
Definition is_in (cells : list cell) (c : cell) : bool := existsb (cell_eqb c) cells.
Definition opens (cells : list cell) (walls : list edge) (c : cell) (s : side) : bool :=
  is_in cells c && is_in cells (beyond c s) && negb (existsb (edge_eqb (edge_of c s)) walls).
Definition floor_of (cells : list cell) (walls : list edge) (c : cell) : list cell :=
  map (beyond c) (filter (opens cells walls c) compass).

Lemma is_in_spec : forall cells c, is_in cells c = true <-> In c cells.
Proof.
  intros cells c; unfold is_in; rewrite existsb_exists; split; [intros [x [I E]]; apply cell_eqb_spec in E; now subst|].
  intros I; exists c; split; [exact I | now apply cell_eqb_spec].
Qed.

Lemma floor_of_spec : forall cells walls u v, In v (floor_of cells walls u) <->
  exists s, opens cells walls u s = true /\ v = beyond u s.
Proof.
  intros cells walls u v; unfold floor_of; rewrite in_map_iff; split; intros [s [A B]]; exists s.
  - apply filter_In in B; now rewrite A.
  - subst; split; [reflexivity|]. apply filter_In; split; [destruct s; cbn; auto | exact A].
Qed.

(** What [is_floor] asks for holds of each, if its cells are joined. *)
Theorem floors_are_floors : forall cells walls first M C0,
  (forall w u, In w cells -> In u cells -> exists d, d <= M /\ steps cell (floor_of cells walls) w d u) ->
  (forall u, first u <= C0) -> is_floor cell cell_eqb (floor_of cells walls) cells first 4 M C0.
Proof.
  intros cells walls first M C0 J Z; split; auto using cell_eqb_spec.
  - intros u v; rewrite !floor_of_spec; intros [s [O ->]]; exists (opposite s). unfold opens in *.
    rewrite edge_of_opposite. pose proof (after_reverse u (Cross s)) as B; cbn [after reverse] in B; rewrite B.
    split; [|reflexivity]. rewrite !andb_true_iff in *; tauto.
  - intros u v _; rewrite floor_of_spec; intros [s [O ->]]; unfold opens in O.
    rewrite !andb_true_iff in O; now apply is_in_spec.
  - intros u; unfold floor_of; rewrite map_length. cbn [filter compass].
    repeat destruct (opens cells walls u _); cbn; lia.
Qed.

(** Replaying: an action is the ant, four times the side's place in the compass, sixteen times the sensors missed. *)
Definition ant_of (a : nat) : nat := a mod 4.
Definition side_of (a : nat) : side := nth (a / 4 mod 4) compass North.
Definition missed_of (a : nat) (c x : cell) : bool :=
  existsb (fun k => Nat.testbit (a / 16) k && cell_eqb x (beyond c (nth k compass North))) (seq 0 4).

Section Replay.
  Variables (r : rule) (cells : list cell) (walls : list edge) (starts : list cell).
  Definition home (i : nat) : cell := nth i starts (0, 0)%Z.
  Definition settled (c : cell) : nat := List.length (filter (cell_eqb c) starts).
  Notation a_run := (run cell cell_eqb (floor_of cells walls) cells (List.length starts) settled r).

  Definition next (s : state cell) (a : nat) : option (state cell) :=
    let here := at_ cell s (ant_of a) in
    let v := beyond here (side_of a) in
    let read := reads cell (missed_of a here) s in
    if (ant_of a <? List.length starts) && opens cells walls here (side_of a)
       && forallb (fun x => read v <=? read x) (floor_of cells walls here)
    then Some (enter cell cell_eqb r s (ant_of a) v (read v)) else None.

  Fixpoint replay (s : state cell) (actions : list nat) : option (state cell) :=
    match actions with
    | [] => Some s
    | a :: actions => match next s a with Some t => replay t actions | None => None end
    end.

  Lemma replay_is_run : forall actions s t m k, a_run m k s -> replay s actions = Some t ->
    exists m', a_run m' (List.length actions + k) t.
  Proof.
    induction actions as [|a actions IH]; intros s t m k R E; cbn [replay] in E; [injection E as <-; eauto|].
    destruct (next s a) as [u|] eqn:X; [|discriminate]. unfold next in X.
    destruct (_ && _ && _) eqn:C in X; [|discriminate]; injection X as <-.
    rewrite !andb_true_iff, Nat.ltb_lt, forallb_forall in C; destruct C as [[L O] F].
    cbn [List.length]; rewrite Nat.add_succ_comm. eapply IH; [|exact E]. apply act with (m := m); auto.
    - apply floor_of_spec; eauto.
    - intros x I; now apply Nat.leb_le, F.
  Qed.
End Replay.

Definition recorded : Type := list cell * list edge * list cell * list nat * list cell * list nat.
Definition recorded_runs : list (rule * list recorded) :=
  [(Lost, runs_Lost); (Beside, runs_Beside); (Counted, runs_Counted); (Repaired, runs_Repaired)].

Definition is_recorded (r : rule) (x : recorded) : bool :=
  let '(cells, walls, starts, actions, last, counts) := x in
  forallb (is_in cells) starts &&
  match replay r cells walls starts {| count := settled starts; at_ := home starts |} actions with
  | Some s => (if list_eq_dec Nat.eq_dec (map (count cell s) cells) counts then true else false)
      && forallb (fun p => cell_eqb (fst p) (snd p)) (combine (map (at_ cell s) (seq 0 (List.length starts))) last)
  | None => false
  end.

Lemma all_recorded : forallb (fun rs => forallb (is_recorded (fst rs)) (snd rs)) recorded_runs = true.
Proof. vm_compute; reflexivity. Qed.

(** Every run of the kernel is one of Ants.v, action by action, and ends with the counts that the kernel has. *)
Theorem kernel_ants_run : forall r rs cells walls starts actions last counts, In (r, rs) recorded_runs ->
  In (cells, walls, starts, actions, last, counts) rs ->
  exists m s, run cell cell_eqb (floor_of cells walls) cells (List.length starts) (settled starts) r m
    (List.length actions) s /\ map (count cell s) cells = counts.
Proof.
  intros r rs cells walls starts actions last counts I J. pose proof all_recorded as A.
  rewrite forallb_forall in A; specialize (A _ I); cbn [fst snd] in A. rewrite forallb_forall in A; specialize (A _ J).
  unfold is_recorded in A; rewrite andb_true_iff, forallb_forall in A; destruct A as [S A].
  destruct (replay _ _ _ _ _ _) as [s|] eqn:E; [|discriminate].
  destruct (list_eq_dec _ _ _) as [C|C]; [|discriminate].
  edestruct replay_is_run with (2 := E) as [m R].
  - apply start; intros i L; apply is_in_spec, S; now apply nth_In.
  - rewrite Nat.add_0_r in R; eauto.
Qed.
