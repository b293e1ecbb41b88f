(** KIT-10: which sides count as covered for robots that keep in touch, for every number of robots, every map and every
    order of what they do.

    Each robot has a record of the paths that it has driven and of the sides that it has seen blocked. It drives wherever
    the rule lets it, which is any relation here. A path is recorded at both of its ends when a robot leaves, and the
    border of the area is known from the start. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Kit.
Import ListNotations.
Local Open Scope nat_scope.

(** What a robot [i] at node [c] does: it drives through a side, sees it blocked, or sees it otherwise and does not drive;
    or it arrives. *)
Inductive event := Leaves (i : nat) (c : cell) (s : side) | SeesBlocked (i : nat) (c : cell) (s : side)
  | SeesOther (i : nat) (c : cell) (s : side) | Comes (i : nat).

(** Where the robots are, each one's record of paths driven and of sides seen blocked, and of each robot whether the path
    that it has driven last was new when it left. *)
Record world := { stances : team; driven : nat -> list edge; blocked : nat -> list edge; fresh : nat -> bool }.

(** Whether a side seen blocked is recorded, and whether a robot's own record counts for it. *)
Record marking := { is_marked : bool; own_counts : bool }.
Definition MARKED : marking := {| is_marked := true; own_counts := true |}.
Definition without_Marked : marking := {| is_marked := false; own_counts := true |}.
Definition others_alone : marking := {| is_marked := true; own_counts := false |}.

Definition has_edge (l : list edge) (e : edge) : bool := existsb (edge_eqb e) l.
Definition with_ {A : Type} (f : nat -> A) (i : nat) (x : A) : nat -> A := fun j => if j =? i then x else f j.

Section Map.
  Variables (N : nat) (m : marking).
  (** The border of the area, and the paths that are blocked, the border among them. *)
  Variables border wall : edge -> bool.
  (** The drives that the rule lets a robot begin. *)
  Variable may : world -> nat -> side -> bool.

  Definition begins (t : team) : world :=
    {| stances := t; driven := fun _ => []; blocked := fun _ => []; fresh := fun _ => false |}.

  Definition in_records (l : nat -> list edge) (e : edge) : bool := existsb (fun i => has_edge (l i) e) (seq 0 N).
  (** Driven by anyone; known to be blocked; neither. *)
  Definition is_driven (w : world) (c : cell) (s : side) : bool := in_records (driven w) (edge_of c s).
  Definition is_blocked (w : world) (c : cell) (s : side) : bool :=
    border (edge_of c s) || in_records (blocked w) (edge_of c s).
  Definition uncovered (w : world) (c : cell) (s : side) : bool := negb (is_driven w c s) && negb (is_blocked w c s).

  (** Whether a side counts as covered for robot [r]. *)
  Definition covered (w : world) (r : nat) (c : cell) (s : side) : bool :=
    (if own_counts m then is_driven w c s
     else existsb (fun i => negb (i =? r) && has_edge (driven w i) (edge_of c s)) (seq 0 N))
    || is_blocked w c s.

  Definition is_at (w : world) (i : nat) (c : cell) : bool :=
    (i <? N) && match stances w i with Stands d => cell_eqb c d | Drives _ _ => false end.

  Definition act (w : world) (e : event) : option world :=
    match e with
    | Leaves i c s => if is_at w i c && negb (wall (edge_of c s)) && may w i s
        then Some {| stances := put (stances w) i (Drives c s);
                     driven := with_ (driven w) i (edge_of c s :: driven w i); blocked := blocked w;
                     fresh := with_ (fresh w) i (negb (is_driven w c s)) |}
        else None
    | SeesBlocked i c s => if is_at w i c && wall (edge_of c s)
        then Some (if is_marked m
          then {| stances := stances w; driven := driven w;
                  blocked := with_ (blocked w) i (edge_of c s :: blocked w i); fresh := fresh w |}
          else w)
        else None
    | SeesOther i c s => if is_at w i c && negb (wall (edge_of c s)) then Some w else None
    | Comes i => match stances w i with
        | Drives c s => if i <? N then Some {| stances := put (stances w) i (Stands (beyond c s)); driven := driven w;
                                               blocked := blocked w; fresh := fresh w |} else None
        | Stands _ => None
        end
    end.

  (** Runs from a start, with what has happened, the last first. *)
  Inductive run (start : team -> Prop) : list event -> world -> Prop :=
  | run_begins : forall t, start t -> run start [] (begins t)
  | run_goes_on : forall l w e w', run start l w -> act w e = Some w' -> run start (e :: l) w'.

  Lemma has_edge_spec : forall l e, has_edge l e = true <-> In e l.
  Proof.
    intros l e; unfold has_edge; rewrite existsb_exists; split; [intros [x [I E]]; apply edge_eqb_spec in E; now subst|].
    intros I; exists e; split; [exact I | now apply edge_eqb_spec].
  Qed.

  Lemma in_records_spec : forall l e, in_records l e = true <-> exists i, i < N /\ In e (l i).
  Proof.
    intros l e; unfold in_records; rewrite existsb_exists; split; intros [i [I H]]; exists i.
    - apply in_seq in I; apply has_edge_spec in H; split; [lia | exact H].
    - split; [apply in_seq; lia | now apply has_edge_spec].
  Qed.

  Lemma in_with : forall (l : nat -> list edge) i e j f, In f (with_ l i (e :: l i) j) <-> In f (l j) \/ j = i /\ f = e.
  Proof.
    intros l i e j f; unfold with_; destruct (Nat.eqb_spec j i) as [->|D]; cbn [In].
    - split; [intros [->|I]; auto | intros [I|[_ ->]]; auto].
    - split; [auto | intros [I|[E _]]; [exact I | contradiction]].
  Qed.

  (** What the records have is what has happened, and it is so. *)
  Definition told (l : list event) (w : world) : Prop :=
    (forall i e, In e (driven w i) <-> exists c s, In (Leaves i c s) l /\ edge_of c s = e)
    /\ (forall i e, In e (blocked w i) <-> is_marked m = true /\ exists c s, In (SeesBlocked i c s) l /\ edge_of c s = e)
    /\ (forall i c s, In (Leaves i c s) l -> i < N /\ wall (edge_of c s) = false)
    /\ (forall i c s, In (SeesBlocked i c s) l -> i < N /\ wall (edge_of c s) = true).

  Lemma other_events : forall l w w' e, told l w -> driven w' = driven w -> blocked w' = blocked w ->
    (forall i c s, e <> Leaves i c s) -> (forall i c s, e <> SeesBlocked i c s) -> told (e :: l) w'.
  Proof.
    clear border may; intros l w w' e [D [B [L W]]] ED EB NL NB. unfold told; rewrite ED, EB.
    assert (forall i c s, In (Leaves i c s) (e :: l) <-> In (Leaves i c s) l) as HL.
    { intros i c s; cbn [In]; split; [intros [E|I]; [now apply NL in E | exact I] | auto]. }
    assert (forall i c s, In (SeesBlocked i c s) (e :: l) <-> In (SeesBlocked i c s) l) as HB.
    { intros i c s; cbn [In]; split; [intros [E|I]; [now apply NB in E | exact I] | auto]. }
    repeat split.
    - intros I; apply D in I; destruct I as [c [s [I E]]]; exists c, s; now rewrite HL.
    - intros [c [s [I E]]]; apply D; exists c, s; now rewrite <- HL.
    - apply B in H; tauto.
    - apply B in H; destruct H as [_ [c [s [I E]]]]; exists c, s; now rewrite HB.
    - intros [M [c [s [I E]]]]; apply B; split; [exact M|]; exists c, s; now rewrite <- HB.
    - apply HL, L in H; tauto.
    - apply HL, L in H; tauto.
    - apply HB, W in H; tauto.
    - apply HB, W in H; tauto.
  Qed.

  Lemma recorded : forall start l w, run start l w -> told l w.
  Proof.
    clear border; intros start l w R; induction R as [t S|l w e w' R T A].
    { unfold told; cbn; repeat split; try tauto; intros; firstorder. }
    destruct e as [i c s|i c s|i c s|i]; cbn [act] in A; pose proof T as [D [B [L W]]].
    - destruct (is_at w i c) eqn:At, (wall (edge_of c s)) eqn:Wa, (may w i s); try discriminate. injection A as <-.
      apply andb_true_iff in At; destruct At as [At _]; apply Nat.ltb_lt in At. cbn [driven blocked]. repeat split.
      + intros I; apply in_with in I; destruct I as [I|[-> ->]]; [|exists c, s; split; [now left | reflexivity]].
        apply D in I; destruct I as [d [u [I <-]]]; exists d, u; split; [now right | reflexivity].
      + intros [d [u [[E|I] <-]]]; apply in_with; [injection E as -> -> ->; auto | left; apply D; eauto].
      + apply B in H; tauto.
      + apply B in H; destruct H as [_ [d [u [I E]]]]; exists d, u; split; [now right | exact E].
      + intros [M [d [u [[E|I] E']]]]; [discriminate | apply B; eauto].
      + destruct H as [E|H]; [injection E as -> -> ->; exact At | apply (L _ _ _ H)].
      + destruct H as [E|H]; [injection E as -> -> ->; exact Wa | apply (L _ _ _ H)].
      + destruct H as [E|H]; [discriminate | apply (W _ _ _ H)].
      + destruct H as [E|H]; [discriminate | apply (W _ _ _ H)].
    - destruct (is_at w i c) eqn:At, (wall (edge_of c s)) eqn:Wa; try discriminate. injection A as <-.
      apply andb_true_iff in At; destruct At as [At _]; apply Nat.ltb_lt in At.
      assert (forall j f, (In f (blocked (if is_marked m then {| stances := stances w; driven := driven w;
        blocked := with_ (blocked w) i (edge_of c s :: blocked w i); fresh := fresh w |} else w) j)
        <-> In f (blocked w j) \/ is_marked m = true /\ j = i /\ f = edge_of c s)) as X.
      { intros j f; destruct (is_marked m); cbn [blocked]; [rewrite in_with; tauto | intuition discriminate]. }
      repeat split.
      + intros I. assert (In e (driven w i0)) as I' by (destruct (is_marked m); exact I).
        apply D in I'; destruct I' as [d [u [I' E]]]; exists d, u; split; [now right | exact E].
      + intros [d [u [[E|I] <-]]]; [discriminate|].
        assert (In (edge_of d u) (driven w i0)) as I' by (apply D; eauto). destruct (is_marked m); exact I'.
      + apply X in H; destruct H as [H|H]; [apply B in H|]; tauto.
      + apply X in H; destruct H as [H|[_ [-> ->]]]; [|exists c, s; split; [now left | reflexivity]].
        apply B in H; destruct H as [_ [d [u [I E]]]]; exists d, u; split; [now right | exact E].
      + intros [M [d [u [[E|I] <-]]]]; apply X; [injection E as -> -> ->; auto | left; apply B; eauto].
      + destruct H as [E|H]; [discriminate | apply (L _ _ _ H)].
      + destruct H as [E|H]; [discriminate | apply (L _ _ _ H)].
      + destruct H as [E|H]; [injection E as -> -> ->; exact At | apply (W _ _ _ H)].
      + destruct H as [E|H]; [injection E as -> -> ->; exact Wa | apply (W _ _ _ H)].
    - destruct (is_at w i c && negb (wall (edge_of c s))); [|discriminate]. injection A as <-.
      apply (other_events l w); try discriminate; auto.
    - destruct (stances w i) as [c|c s]; [discriminate|]. destruct (i <? N); [|discriminate]. injection A as <-.
      apply (other_events l w); try discriminate; auto.
  Qed.
End Map.

(** A side counts as covered for a robot if it is of the border, if any robot has driven through it from either of its
    ends, or if any has seen it blocked there; and no other side does. *)
Theorem KIT_10 : forall N border wall may start l w, run N MARKED wall may start l w -> forall r c s, r < N ->
  covered N MARKED border w r c s = true
  <-> border (edge_of c s) = true
      \/ exists i d u, edge_of d u = edge_of c s /\ (In (Leaves i d u) l \/ In (SeesBlocked i d u) l).
Proof.
  intros N border wall may start l w R r c s _. destruct (recorded _ _ _ _ _ _ _ R) as [D [B [L W]]].
  unfold covered, is_driven, is_blocked; cbn [own_counts MARKED]. rewrite !orb_true_iff, !in_records_spec. split.
  - intros [[i [_ I]]|[E|[i [_ I]]]]; [|now left|].
    + apply D in I; destruct I as [d [u [I E]]]; right; exists i, d, u; auto.
    + apply B in I; destruct I as [_ [d [u [I E]]]]; right; exists i, d, u; auto.
  - intros [E|[i [d [u [E [I|I]]]]]]; [auto | left | right; right]; exists i.
    + split; [apply (L i d u I) | apply D; eauto].
    + split; [apply (W i d u I) | apply B; split; [reflexivity | eauto]].
Qed.

(** Both ends of a path count alike. *)
Theorem covered_at_both_ends : forall N m border w r c s,
  covered N m border w r (beyond c s) (opposite s) = covered N m border w r c s.
Proof. intros; unfold covered, is_driven, is_blocked; now rewrite edge_of_opposite. Qed.

(** ** Each condition is needed. *)
Definition anywhere (w : world) (i : nat) (s : side) : bool := true.
Definition nowhere (e : edge) : bool := false.
Definition east_of (c : cell) (e : edge) : bool := edge_eqb e (edge_of c East).

(** A side that is seen blocked is looked at again. *)
Theorem without_Marked_breaks_KIT_10 : exists l w,
  run 1 without_Marked (east_of (0, 0)%Z) anywhere (fun t => t = standing (0, 0)%Z (1, 0)%Z) l w
  /\ In (SeesBlocked 0 (0, 0)%Z East) l /\ covered 1 without_Marked nowhere w 0 (0, 0)%Z East = false.
Proof.
  exists [SeesBlocked 0 (0, 0)%Z East], (begins (standing (0, 0)%Z (1, 0)%Z)); split; [|split; [now left | reflexivity]].
  eapply run_goes_on; [now apply run_begins | reflexivity].
Qed.

(** A robot whose own record does not count takes a side for uncovered that it has driven through. *)
Theorem others_alone_break_KIT_10 : exists l w,
  run 2 others_alone nowhere anywhere (fun t => t = standing (0, 0)%Z (3, 0)%Z) l w
  /\ In (Leaves 0 (0, 0)%Z East) l /\ covered 2 others_alone nowhere w 0 (0, 0)%Z East = false.
Proof.
  eexists [Leaves 0 (0, 0)%Z East], _; split; [|split; [now left|]].
  - eapply run_goes_on; [now apply run_begins | reflexivity].
  - reflexivity.
Qed.
