(** Agents that take turns where their scans overlap: BRICKS-3, for every number of agents, every floor and every rule by
    which an agent reads and writes no cell but those near it. *)
From Coq Require Import Bool List Arith.
Import ListNotations.

Section Turns.
  (** What an agent decides: what it writes, what it remembers, and where it goes. *)
  Variables (cell note memory : Type) (same : cell -> cell -> bool) (near : cell -> cell -> Prop).
  Definition floor : Type := cell -> note.
  Definition agent : Type := memory * cell.
  Definition plan : Type := list (cell * note) * agent.
  Variable decide : floor -> agent -> plan.

  Definition write (f : floor) (change : cell * note) : floor :=
    fun c => if same c (fst change) then snd change else f c.
  Definition written (f : floor) (p : plan) : floor := fold_left write (fst p) f.
  Definition put {A : Type} (a : nat -> A) (i : nat) (x : A) : nat -> A := fun j => if j =? i then x else a j.

  (** An agent reads near its cell, and writes there. *)
  Definition is_local : Prop :=
    (forall f g a, (forall c, near (snd a) c -> f c = g c) -> decide f a = decide g a)
    /\ (forall f a c n, In (c, n) (fst (decide f a)) -> near (snd a) c).

  (** Runs of whole actions from a floor with agents on it. *)
  Inductive whole (f0 : floor) (team0 : nat -> agent) : floor -> (nat -> agent) -> Prop :=
  | at_first : whole f0 team0 f0 team0
  | acts : forall f team i, whole f0 team0 f team ->
      whole f0 team0 (written f (decide f (team i))) (put team i (snd (decide f (team i)))).

  (** Runs in which scans and writes are apart: what each agent has decided and not yet written. An agent that takes
      turns does not scan while another one has scanned a cell that it scans. *)
  Definition apart (a b : agent) : Prop := forall c, near (snd a) c -> near (snd b) c -> False.
  Inductive stepwise (turns : bool) (f0 : floor) (team0 : nat -> agent) :
    floor -> (nat -> agent) -> (nat -> option plan) -> Prop :=
  | at_start : stepwise turns f0 team0 f0 team0 (fun _ => None)
  | scans : forall f team mind i, stepwise turns f0 team0 f team mind -> mind i = None ->
      (turns = true -> forall j, j <> i -> mind j <> None -> apart (team i) (team j)) ->
      stepwise turns f0 team0 f team (put mind i (Some (decide f (team i))))
  | writes : forall f team mind i p, stepwise turns f0 team0 f team mind -> mind i = Some p ->
      stepwise turns f0 team0 (written f p) (put team i (snd p)) (put mind i None).

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis local : is_local.

  Lemma written_elsewhere : forall ws f c, (forall d n, In (d, n) ws -> d <> c) -> fold_left write ws f c = f c.
  Proof.
    induction ws as [|[d n] ws IH]; intros f c H; [reflexivity|]. cbn [fold_left]. rewrite IH.
    - unfold write; cbn [fst]. destruct (same c d) eqn:E; [|reflexivity]. apply same_spec in E; subst.
      exfalso; exact (H d n (or_introl eq_refl) eq_refl).
    - intros e k I; apply (H e k); now right.
  Qed.

  Theorem turns_are_whole : forall f0 team0 f team mind, stepwise true f0 team0 f team mind ->
    whole f0 team0 f team
    /\ (forall i p, mind i = Some p -> p = decide f (team i))
    /\ (forall i j, i <> j -> mind i <> None -> mind j <> None -> apart (team i) (team j)).
  Proof.
    intros f0 team0 f team mind S.
    induction S as [|f team mind i S [W [D A]] N T | f team mind i p S [W [D A]] M].
    - split; [constructor | split; intros; congruence].
    - split; [exact W|]. split; intros j; unfold put.
      + intros p; destruct (Nat.eqb_spec j i) as [->|E]; [congruence | auto].
      + intros k E; destruct (Nat.eqb_spec j i) as [->|J], (Nat.eqb_spec k i) as [->|K]; intros Mj Mk.
        * contradiction.
        * now apply T.
        * intros c X Y; exact (T eq_refl j J Mj c Y X).
        * now apply A.
    - pose proof (D i p M) as ->. split; [now constructor|].
      split; intros j; unfold put.
      + intros p; destruct (Nat.eqb_spec j i) as [->|E]; [discriminate|]. intros Mj; rewrite (D j p Mj).
        apply (proj1 local); intros c C. symmetry; apply written_elsewhere. intros d n I ->.
        apply (A i j) with c; [congruence | congruence | congruence | | exact C]. exact (proj2 local _ _ _ _ I).
      + intros k E; destruct (Nat.eqb_spec j i) as [->|J], (Nat.eqb_spec k i) as [->|K]; try congruence. now apply A.
  Qed.
End Turns.

(** Whatever is so after every run of whole actions is so after every run in which agents take turns whose scans
    overlap. *)
Theorem BRICKS_3 : forall cell note memory same near (decide : floor cell note -> agent cell memory ->
  plan cell note memory),
  (forall a b, same a b = true <-> a = b) -> is_local cell note memory near decide ->
  forall f0 team0 (kept : floor cell note -> Prop),
  (forall f team, whole cell note memory same decide f0 team0 f team -> kept f) ->
  forall f team mind, stepwise cell note memory same near decide true f0 team0 f team mind -> kept f.
Proof.
  intros cell note memory same near decide E L f0 team0 kept K f team mind S. apply (K f team).
  now apply (turns_are_whole cell note memory same near decide E L f0 team0 f team mind).
Qed.

(** What is needed: each of two agents marks its cell unless the other cell is marked. If both scan before
    either writes, both cells are marked. *)
Definition near_two (a b : bool) : Prop := True.
Definition marks (f : floor bool bool) (a : agent bool unit) : plan bool bool unit :=
  (if f (negb (snd a)) then [] else [(snd a, true)], a).
Definition two (i : nat) : agent bool unit := (tt, i =? 1).

Theorem without_turns_breaks_BRICKS_3 : is_local bool bool unit near_two marks
  /\ (forall f team, whole bool bool unit eqb marks (fun _ => false) two f team -> f true && f false = false)
  /\ exists f team mind, stepwise bool bool unit eqb near_two marks false (fun _ => false) two f team mind
    /\ f true && f false = true.
Proof.
  split; [|split].
  - split; [|intros; exact I]. intros f g a H; unfold marks. now rewrite (H (negb (snd a)) I).
  - intros f team W; induction W as [|f team i W IH]; [reflexivity|]. unfold marks, written; cbn [fst].
    destruct (f (negb (snd (team i)))) eqn:F; [exact IH|]. cbn [fold_left]; unfold write; cbn [fst snd].
    destruct (snd (team i)); cbn in *; rewrite F; reflexivity.
  - do 3 eexists. split.
    + eapply writes with (i := 1); [eapply writes with (i := 0); [eapply scans with (i := 1);
        [eapply scans with (i := 0); [apply at_start | reflexivity | discriminate] | reflexivity | discriminate] |
        reflexivity] | reflexivity].
    + reflexivity.
Qed.
