(** A pack: robots on cells that explore together and stay connected, for every number of robots, every R_c, every layout
    and every run. In a team move robots take one step each, or none, in any order and for any reason, each only if links
    join the whole team then and no robot is in the next cell; or the last team move is taken back. *)
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
  Variables (link : cell -> cell -> bool) (N : nat).

  (** Links join two robots. *)
  Inductive joined (t : team) (i : nat) : nat -> Prop :=
  | joined_self : joined t i i
  | joined_over : forall j k, joined t i j -> k < N -> link (t j) (t k) = true -> joined t i k.
  Definition connected (t : team) : Prop := forall i j, i < N -> j < N -> joined t i j.
  Definition single (t : team) : Prop := forall i j, i < N -> j < N -> t i = t j -> i = j.

  (** Steps of a team move, who has gone by then, and where the team is: nothing is said of robots that there are not. *)
  Inductive goes (t : team) : list nat -> team -> Prop :=
  | goes_not : goes t [] t
  | goes_on : forall gone u i s v, goes t gone u -> i < N -> ~ In i gone -> (forall j, j < N -> u j <> beyond (u i) s) ->
      (forall j, j < N -> v j = put u i (beyond (u i) s) j) -> connected v ->
      goes t (i :: gone) v.
  (** A run, with where the team was before those team moves that can be taken back. *)
  Inductive run : list team -> team -> Prop :=
  | run_start : forall t, connected t -> single t -> run [] t
  | run_move : forall past t gone u, run past t -> goes t gone u -> run (t :: past) u
  | run_back : forall past t u, run (u :: past) t -> run past u.

  Definition good (t : team) : Prop := connected t /\ single t.
  Lemma goes_good : forall t gone u, good t -> goes t gone u -> good u.
  Proof.
    intros t gone u [C S] G; induction G as [|gone u i s v G [_ S'] I O E A D]; [split; assumption|]; split; [exact D|].
    intros j k J K; rewrite !A by assumption; unfold put; intros X.
    destruct (j =? i) eqn:Ej, (k =? i) eqn:Ek; try apply Nat.eqb_eq in Ej; try apply Nat.eqb_eq in Ek; subst; auto.
    - exfalso; exact (E k K (eq_sym X)).
    - exfalso; exact (E j J X).
  Qed.
  Lemma run_good : forall past t, run past t -> good t /\ Forall good past.
  Proof.
    intros past t R; induction R as [t C S | past t gone u R [G F] M | past t u R [_ F]].
    - split; [split|]; auto.
    - split; [eapply goes_good; eauto | auto].
    - inversion F; auto.
  Qed.

  (** No robot is more than a step from where it was. *)
  Definition one_step (t u : team) : Prop := forall i, i < N -> exists s, u i = after (t i) s.
  Lemma goes_one_step : forall t gone u, goes t gone u -> one_step t u.
  Proof.
    intros t gone u G; enough (forall j, j < N -> (~ In j gone -> u j = t j) /\ exists s, u j = after (t j) s) as H.
    { intros j J; apply (H j J). }
    induction G as [|gone u i s v G IH I O E A D]; intros j J; [split; [auto | now exists Stay]|]. rewrite A by exact J; unfold put.
    destruct (Nat.eqb_spec j i) as [->|X]; [|split; [intros U; apply IH; [exact J | intros Y; apply U; now right] | now apply IH]].
    split; [intros U; destruct U; now left|]. exists (Cross s); cbn; f_equal; now apply IH.
  Qed.
  Fixpoint by_steps (past : list team) (t : team) : Prop :=
    match past with [] => True | u :: past => one_step u t /\ by_steps past u end.
  Lemma run_by_steps : forall past t, run past t -> by_steps past t.
  Proof.
    intros past t R; induction R as [|past t gone u R IH G | past t u R [_ IH]]; [exact I | | exact IH].
    split; [eapply goes_one_step; eauto | exact IH].
  Qed.
End Pack.

(** After every team move links join all robots. *)
Theorem PACK_1 : forall range N past t, run (links range) N past t -> connected (links range) N t.
Proof. intros range N past t R; apply run_good in R; apply R. Qed.
(** Nor are two robots in one cell, by whatever links. *)
Theorem PACK_2 : forall link N past t, run link N past t -> single N t.
Proof. intros link N past t R; apply run_good in R; apply R. Qed.

(** In a team move each robot goes one step at most: from [u] to [t], and back if it is taken back. *)
Theorem PACK_6_one_step_at_most : forall link N past t u, run link N (u :: past) t -> forall i, i < N ->
  exists s, t i = after (u i) s /\ u i = after (t i) (reverse s).
Proof.
  intros link N past t u R i I; apply run_by_steps in R; destruct R as [R _]; destruct (R i I) as [s E].
  exists s; split; [exact E|]. rewrite E; symmetry; apply after_reverse.
Qed.

(** By midpoints a step is admitted that parts robots. *)
Theorem published_breaks_PACK_1 : exists past t, run (links_published 4) 2 past t /\ ~ connected (links 4) 2 t.
Proof.
  set (at_ := fun (c : cell) (i : nat) => if i =? 0 then (0, 0)%Z else c).
  assert (forall c, links_published 4 (0, 0)%Z c = true -> links_published 4 c (0, 0)%Z = true ->
    connected (links_published 4) 2 (at_ c)) as Two.
  { intros c A B [|[|i]] [|[|j]] I J; try lia; try apply joined_self;
      (eapply joined_over; [apply joined_self | lia | assumption]). }
  exists [at_ (2, 2)%Z], (at_ (3, 2)%Z); split.
  - eapply run_move.
    + apply run_start; [now apply Two|]. intros [|[|i]] [|[|j]] I J E; try lia; discriminate.
    + apply goes_on with (u := at_ (2, 2)%Z) (i := 1) (s := East); [apply goes_not | lia | intros [] | | | now apply Two].
      * intros [|[|j]] J; try lia; discriminate.
      * intros [|[|j]] J; try lia; reflexivity.
  - intros C; specialize (C 0 1 ltac:(lia) ltac:(lia)).
    assert (forall k, joined (links 4) 2 (at_ (3, 2)%Z) 0 k -> k = 0) as G.
    { intros k H; induction H as [|j k H IH K L]; [reflexivity|]. subst j; destruct k as [|[|k]]; [reflexivity | discriminate | lia]. }
    apply G in C; discriminate.
Qed.
