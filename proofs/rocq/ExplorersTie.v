(** The tie between the kernel and Explorers.v: each run of the kernel's robots in generated/FrontierRuns.v is one of
    the definitions. In each of its states the same robots may act, and go to the same cells; where it ends nobody may act,
    and each robot knows and is where the kernel's is. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Explorers.
From Tautline.generated Require Import FrontierRuns.
Import ListNotations.

Section Floor.
  (** Columns and rows, and the obstacles, by the numbers of their cells: row by row. *)
  Variables (columns rows : nat) (obstacles : list nat) (N : nat).
  Definition cells : list nat := seq 0 (columns * rows).
  Definition beside (u : nat) : list nat :=
    (if columns <=? u then [u - columns] else []) ++ (if u mod columns =? 0 then [] else [u - 1])
    ++ (if S u mod columns =? 0 then [] else [S u]) ++ (if u + columns <? columns * rows then [u + columns] else []).
  Definition rim (u : nat) : nat :=
    Nat.min (Nat.min (u mod columns) (columns - 1 - u mod columns)) (Nat.min (u / columns) (rows - 1 - u / columns)).
  Definition obstacle : nat -> bool := has nat Nat.eqb obstacles.

  Definition plain : rule nat := PLAIN nat Nat.eqb cells beside.
  Definition repaired : rule nat := REPAIRED nat Nat.eqb cells beside N (fun c => c) rim.
  Definition without_Keep : rule nat := PAIRED nat Nat.eqb cells beside N (fun c => c) rim false.

  Section Rule.
    Variable rl : rule nat.

    (** The same state, with the robots in a list, so that it is computed once. *)
    Definition listed (w : world nat) : world nat :=
      match map (robots w) (seq 0 N) with [] => w | r :: l => with_robots nat w (fun i => nth i (r :: l) r) end.
    (** Who may go where. *)
    Definition might (w : world nat) : list (nat * nat) :=
      flat_map (fun i => if may_decide nat rl w i then map (fun p => (i, fst p)) (chooses rl i (robots w i)) else [])
        (seq 0 N).
    Definition same_set {A : Type} (eqb : A -> A -> bool) (l m : list A) : bool :=
      forallb (fun x => existsb (eqb x) m) l && forallb (fun x => existsb (eqb x) l) m.
    Definition eqb_pair (p q : nat * nat) : bool := (fst p =? fst q) && (snd p =? snd q).

    Definition story : Type := list (list (nat * nat) * bool * event nat).
    Fixpoint replay (w : world nat) (s : story) : option (world nat) :=
      match s with
      | [] => Some w
      | (may, ticks, e) :: s =>
          if same_set eqb_pair (might w) may && Bool.eqb (may_tick nat N rl w) ticks
          then match next nat Nat.eqb obstacle N rl w e with Some x => replay (listed x) s | None => None end
          else None
      end.
    Definition is_over (w : world nat) : bool :=
      negb (some N (moves nat w)) && negb (some N (may_decide nat rl w)) && negb (may_tick nat N rl w).
    Definition begins_in (starts : list nat) : world nat := begins nat N (fun i => nth i starts 0).
    Fixpoint are_apart (l : list nat) : bool :=
      match l with [] => true | u :: l => negb (existsb (Nat.eqb u) l) && are_apart l end.
    Definition may_start_in (starts : list nat) : bool :=
      (length starts =? N) && are_apart starts
      && forallb (fun u => existsb (Nat.eqb u) cells && negb (obstacle u)) starts.

    Lemma listed_alike : forall w, alike nat N w (listed w).
    Proof.
      intros w; unfold listed; destruct (map (robots w) (seq 0 N)) as [|r l] eqn:E; [repeat split|].
      repeat split; cbn [robots with_robots]; intros i I. rewrite <- E, (nth_indep _ r (robots w 0)) by (rewrite map_length, seq_length; exact I).
      now rewrite map_nth, seq_nth.
    Qed.
    Lemma replay_runs : forall s w x, run nat Nat.eqb cells obstacle N rl w -> replay w s = Some x ->
      run nat Nat.eqb cells obstacle N rl x.
    Proof.
      induction s as [|[[may ticks] e] s IH]; intros w x R E; cbn [replay] in E; [now injection E as <-|].
      destruct (_ && _); [|discriminate]. destruct (next _ _ _ _ _ w e) as [y|] eqn:X; [|discriminate].
      eapply IH; [|exact E]. eapply run_step; [exact R|]. exists y; split; [exact X | apply listed_alike].
    Qed.
    Lemma begins_runs : forall starts, may_start_in starts = true ->
      run nat Nat.eqb cells obstacle N rl (begins_in starts).
    Proof.
      intros starts E; apply run_start with (start := fun i => nth i starts 0); [|repeat split].
      unfold may_start_in in E; rewrite !andb_true_iff, Nat.eqb_eq, forallb_forall in E; destruct E as [[L A] F]; split.
      - intros i I; assert (In (nth i starts 0) starts) as J by (apply nth_In; lia).
        apply F in J; apply andb_true_iff in J; destruct J as [J K]; apply existsb_exists in J; destruct J as [u [J E]].
        apply Nat.eqb_eq in E; rewrite E; split; [exact J|]. now rewrite <- E, negb_true_iff in *.
      - assert (NoDup starts) as D.
        { clear - A; induction starts as [|u l IH]; constructor; cbn in A; apply andb_true_iff in A; destruct A as [A B].
          - intros I; apply negb_true_iff, not_true_iff_false in A; apply A; apply existsb_exists; exists u.
            now rewrite Nat.eqb_refl.
          - auto. }
        intros i j I J E; apply (proj1 (NoDup_nth starts 0) D); lia.
    Qed.
    Lemma over_ended : forall w, is_over w = true -> ended nat Nat.eqb obstacle N rl w.
    Proof.
      intros w O e w' [x [E _]]; unfold is_over in O; rewrite !andb_true_iff, !negb_true_iff in O; destruct O as [[M D] T].
      assert (forall f i, some N f = false -> i < N -> f i = false) as No.
      { intros f i F I; destruct (f i) eqn:X; [|reflexivity]. rewrite <- F; symmetry; apply some_spec; eauto. }
      destruct e as [i v c missed | i missed unheard s | i missed |]; cbn [next] in E.
      - destruct (i <? N) eqn:I; [|discriminate]; apply Nat.ltb_lt in I. now rewrite (No _ i D I) in E.
      - destruct (i <? N) eqn:I; [apply Nat.ltb_lt in I; pose proof (No _ i M I) as X; unfold moves in X|];
          destruct (doing (robots w i)); discriminate.
      - destruct (i <? N) eqn:I; [apply Nat.ltb_lt in I; pose proof (No _ i M I) as X; unfold moves in X|];
          destruct (doing (robots w i)); discriminate.
      - rewrite T in E; discriminate.
    Qed.
  End Rule.
End Floor.

(** Robots, columns and rows; obstacles; starts; what happened; and what each robot knows at the end, and where it is. *)
Definition run_of_kernel : Type :=
  (nat * nat * nat) * list nat * list nat * story * list (list nat * list nat * nat).

Definition end_of (rl : nat -> nat -> nat -> rule nat) (r : run_of_kernel) : option (world nat) :=
  let '((n, columns, rows), obstacles, starts, s, _) := r in
  if may_start_in columns rows obstacles n starts
  then replay obstacles n (rl n columns rows) (begins_in n starts) s else None.

Definition is_at (r : robot nat) (k : list nat * list nat * nat) : bool :=
  let '(known, barred, at_) := k in
  same_set Nat.eqb (explored r) known && same_set Nat.eqb (blocked r) barred && (place r =? at_).

Definition is_run (rl : nat -> nat -> nat -> rule nat) (r : run_of_kernel) : bool :=
  match end_of rl r with
  | Some w => let '((n, columns, rows), _, _, _, known) := r in
      is_over n (rl n columns rows) w && (length known =? n)
      && forallb (fun p => is_at (fst p) (snd p)) (combine (map (robots w) (seq 0 n)) known)
  | None => false
  end.

Definition plain_of (n columns rows : nat) : rule nat := plain columns rows.
Definition repaired_of (n columns rows : nat) : rule nat := repaired columns rows n.
Definition without_Keep_of (n columns rows : nat) : rule nat := without_Keep columns rows n.
Definition runs_of_kernel : list ((nat -> nat -> nat -> rule nat) * list run_of_kernel) :=
  [(plain_of, runs_PLAIN); (repaired_of, runs_REPAIRED)].

(** Each run is one by its rule, those of one rule are none by the other one, and the last one is none without Keep. *)
Lemma all_are_runs : forallb (fun rs => forallb (is_run (fst rs)) (snd rs)) runs_of_kernel = true
  /\ forallb (is_run repaired_of) runs_PLAIN = false /\ forallb (is_run plain_of) runs_REPAIRED = false
  /\ match rev runs_REPAIRED with r :: _ => is_run without_Keep_of r = false | [] => False end.
Proof.
  split; [vm_cast_no_check (eq_refl true)|]. split; [vm_cast_no_check (eq_refl false)|].
  split; vm_cast_no_check (eq_refl false).
Qed.

Theorem kernel_runs_are_runs : forall rl rs n columns rows obstacles starts s known, In (rl, rs) runs_of_kernel ->
  In ((n, columns, rows), obstacles, starts, s, known) rs ->
  exists w, run nat Nat.eqb (cells columns rows) (obstacle obstacles) n (rl n columns rows) w
    /\ ended nat Nat.eqb (obstacle obstacles) n (rl n columns rows) w
    /\ forallb (fun p => is_at (fst p) (snd p)) (combine (map (robots w) (seq 0 n)) known) = true.
Proof.
  intros rl rs n columns rows obstacles starts s known I J; destruct all_are_runs as [A _]; rewrite forallb_forall in A.
  specialize (A _ I); cbn [fst snd] in A; rewrite forallb_forall in A; specialize (A _ J); unfold is_run in A.
  destruct (end_of rl _) as [w|] eqn:E; [|discriminate]; rewrite !andb_true_iff in A; destruct A as [[O _] K].
  exists w; split; [|split; [eapply over_ended; exact O | exact K]]. unfold end_of in E; destruct (may_start_in _ _ _ _ _) eqn:M; [|discriminate].
  eapply replay_runs; [eapply begins_runs; exact M | exact E].
Qed.
