(** A pack: robots on cells that explore together and stay connected, for every number of robots, every R_c, every layout
    and every run. In a team move robots take one step each, or none, in any order and for any reason, each only if links
    join the whole team then, and into a cell that is known to be free and has no robot; or the last team move is taken
    back. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice.
Import ListNotations.

(** The corners of a cell as seen from its midpoint, in half cells. *)
Definition corners : list (Z * Z) := [(-1, -1); (-1, 1); (1, -1); (1, 1)]%Z.
(** The whole cell [b] is within [range] cells of the midpoint of [a]: its corners are. *)
Definition links (range : Z) (a b : cell) : bool :=
  forallb (fun c => let x := (2 * (fst b - fst a) + fst c)%Z in let y := (2 * (snd b - snd a) + snd c)%Z in
    (x * x + y * y <=? 4 * (range * range))%Z) corners.
(** As published: the midpoints are within [range] cells of each other. *)
Definition links_published (range : Z) (a b : cell) : bool :=
  let x := (fst b - fst a)%Z in let y := (snd b - snd a)%Z in (x * x + y * y <=? range * range)%Z.

Definition team := nat -> cell.
Definition put (t : team) (i : nat) (c : cell) : team := fun j => if j =? i then c else t j.

Section Pack.
  Variables (free : cell -> Prop) (link : cell -> cell -> bool) (N : nat).

  (** Links join two robots. *)
  Inductive joined (t : team) (i : nat) : nat -> Prop :=
  | joined_self : joined t i i
  | joined_over : forall j k, joined t i j -> k < N -> link (t j) (t k) = true -> joined t i k.
  Definition connected (t : team) : Prop := forall i j, i < N -> j < N -> joined t i j.
  Definition single (t : team) : Prop := forall i j, i < N -> j < N -> t i = t j -> i = j.

  (** Steps of a team move, who has gone by then, and where the team is: nothing is said of robots that there are not. *)
  Inductive goes (known : cell -> Prop) (t : team) : list nat -> team -> Prop :=
  | goes_not : goes known t [] t
  | goes_on : forall gone u i s v, goes known t gone u -> i < N -> ~ In i gone -> known (beyond (u i) s) -> (forall j, j < N -> u j <> beyond (u i) s) ->
      (forall j, j < N -> v j = put u i (beyond (u i) s) j) -> connected v ->
      goes known t (i :: gone) v.
  (** A run, with where the team was before those team moves that can be taken back. What robots know to be free is
      so; that may be any cells. *)
  Inductive run : list team -> team -> Prop :=
  | run_start : forall t, connected t -> single t -> (forall i, i < N -> free (t i)) -> run [] t
  | run_move : forall past t (known : cell -> Prop) gone u, run past t -> (forall c, known c -> free c) -> goes known t gone u ->
      run (t :: past) u
  | run_back : forall past t u, run (u :: past) t -> run past u.

  Definition good (t : team) : Prop := connected t /\ single t.
  Lemma goes_good : forall known t gone u, good t -> goes known t gone u -> good u.
  Proof.
    intros known t gone u [C S] G; induction G as [|gone u i s v G [_ S'] I O K' E A D]; [split; assumption|]; split; [exact D|].
    intros j k J K; rewrite !A by assumption; unfold put; intros X.
    destruct (j =? i) eqn:Ej, (k =? i) eqn:Ek; try apply Nat.eqb_eq in Ej; try apply Nat.eqb_eq in Ek; subst; auto.
    - exfalso; exact (E k K (eq_sym X)).
    - exfalso; exact (E j J X).
  Qed.
  Lemma run_good : forall past t, run past t -> good t /\ Forall good past.
  Proof.
    intros past t R; induction R as [t C S _ | past t known gone u R [G F] K M | past t u R [_ F]].
    - split; [split|]; auto.
    - split; [eapply goes_good; eauto | auto].
    - inversion F; auto.
  Qed.

  (** No robot is more than a step from where it was. *)
  Definition one_step (t u : team) : Prop := forall i, i < N -> exists s, u i = after (t i) s.
  Lemma goes_one_step : forall known t gone u, goes known t gone u -> one_step t u.
  Proof.
    intros known t gone u G; enough (forall j, j < N -> (~ In j gone -> u j = t j) /\ exists s, u j = after (t j) s) as H.
    { intros j J; apply (H j J). }
    induction G as [|gone u i s v G IH I O K E A D]; intros j J; [split; [auto | now exists Stay]|]. rewrite A by exact J; unfold put.
    destruct (Nat.eqb_spec j i) as [->|X]; [|split; [intros U; apply IH; [exact J | intros Y; apply U; now right] | now apply IH]].
    split; [intros U; destruct U; now left|]. exists (Cross s); cbn; f_equal; now apply IH.
  Qed.
  Fixpoint by_steps (past : list team) (t : team) : Prop :=
    match past with [] => True | u :: past => one_step u t /\ by_steps past u end.
  Lemma run_by_steps : forall past t, run past t -> by_steps past t.
  Proof.
    intros past t R; induction R as [|past t known gone u R IH K G | past t u R [_ IH]]; [exact I | | exact IH].
    split; [eapply goes_one_step; eauto | exact IH].
  Qed.

  Definition all_free (t : team) : Prop := forall i, i < N -> free (t i).
  Lemma run_free : forall past t, run past t -> all_free t /\ Forall all_free past.
  Proof.
    intros past t R; induction R as [t C S F | past t known gone u R [F P] K G | past t u R [_ F]].
    - auto.
    - split; [|auto]. induction G as [|gone u i s v G IH I O Y E A D]; [exact F|]. intros j J; rewrite A by exact J; unfold put.
      destruct (j =? i); [now apply K | now apply IH].
    - inversion F; auto.
  Qed.
End Pack.

(** After every team move links join all robots. *)
Theorem PACK_1 : forall free range N past t, run free (links range) N past t -> connected (links range) N t.
Proof. intros free range N past t R; apply run_good in R; apply R. Qed.
(** Nor are two robots in one cell, by whatever links. *)
Theorem PACK_2 : forall free link N past t, run free link N past t -> single N t.
Proof. intros free link N past t R; apply run_good in R; apply R. Qed.

(** Each robot is in a free cell, and in a team move goes one step at most: from [u], where it was, and back if the move is
    taken back. *)
Theorem PACK_6 : forall free link N past t, run free link N past t -> forall i, i < N ->
  free (t i) /\ forall u older, past = u :: older -> exists s, t i = after (u i) s /\ u i = after (t i) (reverse s).
Proof.
  intros free link N past t R i I; split; [now apply run_free in R; apply R|]. intros u older ->.
  apply run_by_steps in R; destruct R as [R _]; destruct (R i I) as [s E].
  exists s; split; [exact E|]. rewrite E; symmetry; apply after_reverse.
Qed.

(** By midpoints a step is admitted that parts robots. *)
Theorem published_breaks_PACK_1 : exists past t,
  run (fun _ => True) (links_published 4) 2 past t /\ ~ connected (links 4) 2 t.
Proof.
  set (at_ := fun (c : cell) (i : nat) => if i =? 0 then (0, 0)%Z else c).
  assert (forall c, links_published 4 (0, 0)%Z c = true -> links_published 4 c (0, 0)%Z = true ->
    connected (links_published 4) 2 (at_ c)) as Two.
  { intros c A B [|[|i]] [|[|j]] I J; try lia; try apply joined_self;
      (eapply joined_over; [apply joined_self | lia | assumption]). }
  exists [at_ (2, 2)%Z], (at_ (3, 2)%Z); split.
  - eapply run_move.
    + apply run_start; [now apply Two | | auto]. intros [|[|i]] [|[|j]] I J E; try lia; discriminate.
    + intros c K; exact K.
    + apply goes_on with (u := at_ (2, 2)%Z) (i := 1) (s := East); [apply goes_not | lia | intros [] | exact I | | | now apply Two].
      * intros [|[|j]] J; try lia; discriminate.
      * intros [|[|j]] J; try lia; reflexivity.
  - intros C; specialize (C 0 1 ltac:(lia) ltac:(lia)).
    assert (forall k, joined (links 4) 2 (at_ (3, 2)%Z) 0 k -> k = 0) as G.
    { intros k H; induction H as [|j k H IH K L]; [reflexivity|]. subst j; destruct k as [|[|k]]; [reflexivity | discriminate | lia]. }
    apply G in C; discriminate.
Qed.
