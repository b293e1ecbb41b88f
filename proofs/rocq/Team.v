(** A team of N robots in any layout: admitted plans, what comes of them, backtracks, and all that can be
    reached.

    Lattice.v, Rule.v and this file up to [reachable] are what the theorems about the chain speak of. Robots are
    counted from 0: robot 0 is the base R_1, robot N-1 the leader R_N. A run begins with all robots in the base.
    An advance is any admitted plan, whatever preferred it; each robot that meets a wall stays. A backtrack may
    come at any time, and the world is asked again. The rest of the file is the composition that all theorems
    share: what admitted advances keep holds in every run, backtracks included. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule.
Import ListNotations.

Definition team := nat -> cell.
Definition plan := nat -> step.

(** Some robot below [n]; every robot below [n]; how many. *)
Definition some (n : nat) (p : nat -> bool) : bool := existsb p (seq 0 n).
Definition every (n : nat) (p : nat -> bool) : bool := forallb p (seq 0 n).
Definition count (n : nat) (p : nat -> bool) : nat := length (filter p (seq 0 n)).

Lemma some_spec : forall n p, some n p = true <-> exists i, i < n /\ p i = true.
Proof.
  intros n p; unfold some; rewrite existsb_exists; split; intros [i [H E]]; exists i; rewrite in_seq in *; split;
    auto; lia.
Qed.

Lemma every_spec : forall n p, every n p = true <-> forall i, i < n -> p i = true.
Proof.
  intros n p; unfold every; rewrite forallb_forall; split; intros H i L; apply H; rewrite in_seq in *; lia.
Qed.

(** Two different robots count as two. *)
Lemma count_two : forall n p i j, i < n -> j < n -> i <> j -> p i = true -> p j = true -> 2 <= count n p.
Proof.
  intros n p i j Li Lj D Pi Pj; unfold count.
  change 2 with (length [i; j]); apply NoDup_incl_length.
  - repeat constructor; cbn; intuition.
  - intros k [<-|[<-|[]]]; apply filter_In; split; auto; apply in_seq; lia.
Qed.

Section Layout.
  (** How many robots, the rule, where the base is, and where the walls are: anything. *)
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable wall : edge -> bool.

  (** Where the team is, the edges it knows to be open, and the steps made in the advances not yet taken back. *)
  Record state := { pos : team; open : edge -> bool; log : list plan }.

  Definition start : state := {| pos := fun _ => base; open := fun _ => false; log := [] |}.

  Definition crosses (p : team) (pl : plan) (e : edge) (i : nat) : bool :=
    match pl i with Cross s => edge_eqb (edge_of (p i) s) e | Stay => false end.

  Definition as_move (st : state) (pl : plan) (i : nat) : move :=
    {| from := pos st i; does := pl i;
       known_open := match pl i with Cross s => open st (edge_of (pos st i) s) | Stay => false end |}.

  Definition planned (st : state) (pl : plan) (i : nat) : cell := to (as_move st pl i).

  Definition occupants (p : team) (c : cell) : nat := count N (fun j => cell_eqb (p j) c).

  Definition is_leader (i : nat) : bool := S i =? N.
  Definition role_of (i : nat) : role := if is_leader i then Leader else Follower.

  Definition stays (pl : plan) (i : nat) : bool := match pl i with Stay => true | _ => false end.

  (** What the conditions say of robot i alone, i >= 1: CoveredBehind, the leader's null move excepted, and the
      full cell. *)
  Definition admits_robot (st : state) (pl : plan) (i : nat) : bool :=
    ((is_leader i && stays pl i) || admits_behind rl (planned st pl i) (pos st (pred i)))
    && (stays pl i || cell_eqb (planned st pl i) base
        || admits_entry rl (role_of i) (occupants (pos st) (planned st pl i))).

  (** Distinct, of two robots. *)
  Definition admits_both (st : state) (pl : plan) (i j : nat) : bool :=
    negb (distinct rl) || (i =? j) || negb (cell_eqb (planned st pl i) (planned st pl j))
    || cell_eqb (planned st pl i) base.

  (** The admission relation. Known walls, virtual obstacles and preferences restrict a plan further: not asked for. *)
  Definition admitted (st : state) (pl : plan) : bool :=
    stays pl 0
    && every (pred N) (fun i => admits_ahead rl (as_move st pl i) (as_move st pl (S i)))
    && every (pred N) (fun i => admits_robot st pl (S i))
    && every N (fun i => every N (fun j => admits_both st pl i j)).

  (** The world: who meets a wall stays. *)
  Definition arrives (c : cell) (s : step) : bool :=
    match s with Cross s => negb (wall (edge_of c s)) | Stay => true end.
  Definition made (p : team) (pl : plan) : plan := fun i => if arrives (p i) (pl i) then pl i else Stay.
  Definition moved (p : team) (pl : plan) : team := fun i => after (p i) (made p pl i).

  (** An advance: all move at once, and all learn which edges were crossed. *)
  Definition advance (st : state) (pl : plan) : state :=
    {| pos := moved (pos st) pl;
       open := fun e => open st e || some N (crosses (pos st) (made (pos st) pl) e);
       log := made (pos st) pl :: log st |}.

  (** A backtrack: everybody tries its last step that is not taken back, in reverse. The world is asked again. *)
  Definition undo (pl : plan) : plan := fun i => reverse (pl i).
  Definition backtrack (st : state) (pl : plan) (rest : list plan) : state :=
    {| pos := moved (pos st) (undo pl); open := open st; log := rest |}.

  (** Robots beyond the N-th are none: two states are the same if they agree on the others. *)
  Definition same (p q : team) : Prop := forall i, i < N -> p i = q i.
  Definition same_plan (a b : plan) : Prop := forall i, i < N -> a i = b i.
  Definition alike (a b : state) : Prop :=
    same (pos a) (pos b) /\ (forall e, open a e = open b e) /\ Forall2 same_plan (log a) (log b).

  (** Runs, with where the team was after 0, 1, ... team moves, the latest first. Backtracks may come at any time. *)
  Inductive run : list team -> state -> Prop :=
  | run_start : forall st, alike start st -> run [pos st] st
  | run_advance : forall past st pl st',
      run past st -> admitted st pl = true -> alike (advance st pl) st' -> run (pos st' :: past) st'
  | run_backtrack : forall past st pl rest st',
      run past st -> log st = pl :: rest -> alike (backtrack st pl rest) st' -> run (pos st' :: past) st'.

  Definition reachable (st : state) : Prop := exists past, run past st.

  (** What is known to be open is no wall. *)
  Definition sound (st : state) : Prop := forall e, open st e = true -> wall e = false.

  Lemma same_refl : forall p, same p p. Proof. intros p i _; reflexivity. Qed.
  Lemma same_sym : forall p q, same p q -> same q p. Proof. intros p q H i L; symmetry; auto. Qed.
  Lemma same_trans : forall p q r, same p q -> same q r -> same p r.
  Proof. intros p q r H K i L; rewrite H; auto. Qed.

  (** Where the team was before the advances that can be taken back, one after the other: [past] explains [log]. *)
  Inductive explains (Inv : team -> Prop) (Link : team -> team -> Prop) : team -> list plan -> Prop :=
  | explains_nil : forall p, Inv p -> explains Inv Link p []
  | explains_cons : forall p q pl rest,
      Inv p -> same p (moved q pl) -> (forall i, i < N -> arrives (q i) (pl i) = true) ->
      Link q p -> explains Inv Link q rest -> explains Inv Link p (pl :: rest).

  Lemma made_arrives : forall p pl i, arrives (p i) (made p pl i) = true.
  Proof.
    intros p pl i; unfold made; destruct (arrives (p i) (pl i)) eqn:E; [exact E | reflexivity].
  Qed.

  Lemma moved_made : forall p pl i, moved p (made p pl) i = moved p pl i.
  Proof. intros p pl i; unfold moved; unfold made at 1; rewrite made_arrives; reflexivity. Qed.

  Lemma arrives_back : forall c s, arrives c s = true -> arrives (after c s) (reverse s) = true.
  Proof. intros c [s|]; cbn; [rewrite edge_of_opposite; auto | auto]. Qed.

  (** A backtrack meets no wall and brings the team back: proved, not assumed. *)
  Lemma moved_back : forall p q pl,
    (forall i, i < N -> arrives (q i) (pl i) = true) -> same p (moved q pl) ->
    same (moved p (undo pl)) q /\ (forall i, i < N -> arrives (p i) (undo pl i) = true).
  Proof.
    intros p q pl A S; split; intros i L; specialize (A i L); specialize (S i L).
    - unfold moved in *; unfold made in *; rewrite A in S. rewrite S. unfold undo.
      rewrite arrives_back by exact A. apply after_reverse.
    - unfold moved, made in S; rewrite A in S; rewrite S; unfold undo; now apply arrives_back.
  Qed.

  Lemma sound_advance : forall st pl, sound st -> sound (advance st pl).
  Proof.
    intros st pl K e; cbn; rewrite orb_true_iff; intros [H|H]; [now apply K|].
    apply some_spec in H; destruct H as [i [_ H]]; unfold crosses in H.
    pose proof (made_arrives (pos st) pl i) as A.
    destruct (made (pos st) pl i) as [s|]; [|discriminate].
    apply edge_eqb_spec in H; cbn in A; rewrite H in A; now destruct (wall e).
  Qed.

  (** The composition, once for all clauses. [Inv] speaks of where the team is, [Link] of where it was before
      and after a team move. If admitted advances keep [Inv] and bring about [Link], both hold of every run: of
      every number of robots, layout, order of preference, and choice of when to take back. *)
  Section Composition.
    Variable Inv : team -> Prop.
    Variable Link : team -> team -> Prop.
    Hypothesis Inv_same : forall p q, same p q -> Inv p -> Inv q.
    Hypothesis Link_same : forall p p' q q', same p p' -> same q q' -> Link p q -> Link p' q'.
    Hypothesis Link_sym : forall p q, Link p q -> Link q p.
    Hypothesis Inv_start : Inv (fun _ => base).
    Hypothesis step_lemma : forall st pl,
      sound st -> pos st 0 = base -> Inv (pos st) -> admitted st pl = true ->
      Inv (moved (pos st) pl) /\ Link (pos st) (moved (pos st) pl).

    Hypothesis one_robot : 1 <= N.

    Definition Inv0 (p : team) : Prop := p 0 = base /\ Inv p.

    Lemma Inv0_same : forall p q, same p q -> Inv0 p -> Inv0 q.
    Proof. intros p q S [B I]; split; [rewrite <- B; symmetry; apply S; lia | eauto]. Qed.

    Lemma explains_same : forall p q l, same p q -> explains Inv0 Link p l -> explains Inv0 Link q l.
    Proof.
      intros p q l S E; destruct E as [p I | p o pl rest I S' A K E].
      - constructor; eapply Inv0_same; eauto.
      - apply explains_cons with (q := o); auto.
        + eapply Inv0_same; eauto.
        + eapply same_trans; [apply same_sym; exact S | exact S'].
        + eapply Link_same; [apply same_refl | exact S | exact K].
    Qed.

    Lemma explains_log : forall p l, explains Inv0 Link p l -> forall l', Forall2 same_plan l l' ->
      explains Inv0 Link p l'.
    Proof.
      intros p l E; induction E as [p I | p o pl rest I S A K E IH]; intros l' F;
        inversion F as [|? pl' ? rest' SP F']; subst.
      - now constructor.
      - apply explains_cons with (q := o); auto.
        + intros i L; rewrite (S i L); unfold moved, made; now rewrite (SP i L).
        + intros i L; rewrite <- (SP i L); auto.
    Qed.

    Lemma explains_inv : forall p l, explains Inv0 Link p l -> Inv0 p.
    Proof. intros p l []; auto. Qed.

    Definition linked (past : list team) : Prop := match past with p :: q :: _ => Link q p | _ => True end.

    Lemma alike_good : forall a b, alike a b -> sound a -> explains Inv0 Link (pos a) (log a) ->
      sound b /\ explains Inv0 Link (pos b) (log b).
    Proof.
      intros a b [S [O F]] K E; split.
      - intros e; rewrite <- O; apply K.
      - eapply explains_log; [eapply explains_same; [exact S | exact E] | exact F].
    Qed.

    Theorem composition : forall past st, run past st ->
      sound st /\ explains Inv0 Link (pos st) (log st) /\ linked past
      /\ (exists older, past = pos st :: older) /\ Forall Inv0 past.
    Proof.
      assert (Inv0 (fun _ => base)) as Z by (split; auto).
      intros past st R; induction R as [st Al | past st pl st' R [K [E [L [[older ->] F]]]] A Al
                                        | past st pl rest st' R [K [E [L [[older ->] F]]]] G Al].
      - destruct (alike_good _ _ Al) as [K E]; [intros e; discriminate | constructor; exact Z|].
        split; [exact K|]. split; [exact E|]. split; [exact I|]. split; [eauto|].
        constructor; [eapply explains_inv; exact E | constructor].
      - destruct (explains_inv _ _ E) as [B J].
        destruct (step_lemma st pl K B J A) as [J' L'].
        assert (Inv0 (moved (pos st) pl)) as Z'.
        { split; [|exact J']. unfold moved, made. unfold admitted in A. rewrite !andb_true_iff in A.
          destruct A as [[[A _] _] _]; unfold stays in A; destruct (pl 0); [discriminate|]; exact B. }
        destruct (alike_good _ _ Al) as [K' E'].
        { now apply sound_advance. }
        { cbn; econstructor; eauto.
          - intros i _; cbn; symmetry; apply moved_made.
          - intros i _; apply made_arrives. }
        split; [exact K'|]. split; [exact E'|]. split; [|split; [eauto|constructor; [|exact F]]].
        + cbn; eapply Link_same; [apply same_refl | apply Al | exact L'].
        + eapply explains_inv; exact E'.
      - rewrite G in E; inversion E as [|p q pl' rest' J S A L' E0]; subst.
        destruct (moved_back _ _ _ A S) as [S' A'].
        destruct (alike_good _ _ Al) as [K' E'].
        { exact K. }
        { eapply explains_same; [apply same_sym; exact S' | exact E0]. }
        split; [exact K'|]. split; [exact E'|]. split; [|split; [eauto|constructor; [|exact F]]].
        + cbn; eapply Link_same; [apply same_refl | | apply Link_sym; exact L'].
          eapply same_trans; [apply same_sym; exact S' | apply Al].
        + eapply explains_inv; exact E'.
    Qed.

    (** A backtrack meets no wall: the kernel need not ask. *)
    Theorem backtrack_arrives : forall past st pl rest, run past st -> log st = pl :: rest ->
      forall i, i < N -> arrives (pos st i) (undo pl i) = true.
    Proof.
      intros past st pl rest R G; destruct (composition _ _ R) as [_ [E _]]; rewrite G in E.
      inversion E as [|p q pl' rest' J S A L' E0]; subst. now apply (moved_back _ _ _ A S).
    Qed.
  End Composition.
End Layout.
