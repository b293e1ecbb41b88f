(** Certificates of local rules. A rule is given by tables: what robots in each state can do, which plans of some robots
    it admits, what it promises of them, and how they may start. A certificate is a set of relative places. [accepts]
    checks by enumeration that robots start within the set, that no admitted step leaves it, and that it is within the
    promise; [sound] says that then the rule keeps its promise for every number of robots, every layout and every run.

    States, acts and colours are numbers. An act of a state is where it leads and what may come of it: whether the robot
    goes, and its next state. Where robots are too far from each other for a table, it admits everything. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice.
From Tautline Require Local.
Import ListNotations.
Local Open Scope Z_scope.

(** A set of offsets for each sequence of kinds of robots: a branch for each kind of the first one, of the next one, and
    so on. A leaf has a bit for each place of the others; [All] is every place. *)
Inductive tree := All | Leaf (bits : N) | Node (branches : list tree).

Record rule := {
  robots : nat;
  colours : nat;
  (** How far the promise looks, and whether it is kept by robots that are farther from each other. *)
  reach : Z;
  far : bool;
  moves : list (list ((Z * Z) * list (bool * nat)));
  (** How far the tables of plans and starts look. *)
  width : Z;
  admitted : tree;
  promised : tree;
  started : tree
}.
Record certificate := { window : Z; kept : tree }.

(** The place of offsets that are at most [w] columns and rows, and the entry of a table there. *)
Fixpoint place (w : Z) (l : list cell) : Z :=
  match l with
  | [] => 0
  | (x, y) :: l => (x + w) * (2 * w + 1) + (y + w) + (2 * w + 1) * (2 * w + 1) * place w l
  end.
Fixpoint find (t : tree) (kinds : list nat) : tree :=
  match kinds, t with k :: kinds, Node l => find (nth k l (Leaf 0)) kinds | _, _ => t end.
Definition entry (t : tree) (w : Z) (kinds : list nat) (l : list cell) : bool :=
  match find t kinds with All => true | Leaf b => N.testbit b (Z.to_N (place w (tl l))) | Node _ => false end.

(** Whether all of [n] entries of [xs] have a property. *)
Fixpoint every {A : Type} (n : nat) (xs : list A) (p : list A -> bool) : bool :=
  match n with O => p [] | S n => forallb (fun x => every n xs (fun l => p (x :: l))) xs end.

Lemma every_all : forall (A : Type) n (xs : list A) p, every n xs p = true ->
  forall l, length l = n -> Forall (fun x => In x xs) l -> p l = true.
Proof.
  induction n as [|n IH]; intros xs p E l L F.
  - destruct l; [exact E | discriminate].
  - destruct l as [|x l]; [discriminate|]; inversion F; subst; cbn in E; rewrite forallb_forall in E.
    apply (IH xs (fun l => p (x :: l))); auto.
Qed.

Section Rule.
  Variable r : rule.

  Notation now := (Local.now nat nat).
  Notation plan := (Local.plan nat nat nat).
  Notation at_ := (Local.at_ nat nat).
  Notation is_ := (Local.is_ nat nat).
  Notation on := (Local.on nat nat).
  Notation own := (Local.own nat nat nat).

  Definition move (s a : nat) : (Z * Z) * list (bool * nat) := nth a (nth s (moves r) []) ((0, 0), []).
  Definition leads (s a : nat) : Z * Z := fst (move s a).
  Definition ends (s a : nat) : list (bool * nat) := snd (move s a).
  Definition states : list nat := seq 0 (length (moves r)).
  Definition most_acts : nat := list_max (map (@length _) (moves r)).
  Definition acts : list nat := seq 0 most_acts.

  Definition kind (n : now) : nat := is_ n * colours r + on n.
  Definition plan_kind (p : plan) : nat :=
    ((is_ (own p) * most_acts + Local.does nat nat nat p) * colours r + on (own p)) * colours r
    + Local.aims nat nat nat p.

  Definition near (w : Z) (l : list now) : bool := Local.near nat nat w l.
  Definition admits (l : list plan) : bool :=
    let nows := map own l in
    if near (width r) nows then entry (admitted r) (width r) (map plan_kind l) (map at_ nows) else true.
  (** The promise and the starts of robots that are seen from the first one. *)
  Definition promises (l : list now) : bool :=
    if near (reach r) l then entry (promised r) (reach r) (map kind l) (map at_ l) else far r.
  Definition may_start (l : list now) : bool :=
    if near (width r) l then entry (started r) (width r) (map kind l) (map at_ l) else far r.

  (** The rule keeps its promise: for every number of robots [N], every layout, every set of tuples of robots, every
      start that the rule has, and every run. *)
  Definition holds : Prop := forall N (layout : cell -> nat) (bound : list nat -> Prop) (start : Local.team nat -> Prop),
    (forall c, (layout c < colours r)%nat) ->
    (forall is, bound is -> length is = robots r /\ Forall (fun i => (i < N)%nat) is) ->
    (forall t, start t -> (forall i, (i < N)%nat -> (snd (t i) < length (moves r))%nat)
      /\ forall is, bound is -> may_start (Local.rel nat nat (map (Local.sees nat nat layout t) is)) = true) ->
    forall past t, Local.run nat nat nat leads ends admits N layout bound start past t ->
    forall is, bound is -> promises (Local.rel nat nat (map (Local.sees nat nat layout t) is)) = true.

  Section Check.
    Variable c : certificate.

    Definition good (l : list now) : bool :=
      if promises l then entry (kept c) (window c) (map kind l) (map at_ l) else false.
    Definition safe (l : list now) : bool := if near (window c) l then good l else far r.

    Definition nows (cells : list cell) : list now :=
      flat_map (fun d => flat_map (fun s => map (fun i => Local.Build_now nat nat d s i) (seq 0 (colours r))) states)
        cells.
    Definition starts_are_safe : bool :=
      forallb (fun h => every (pred (robots r)) (nows (Local.box (width r)))
        (fun l => implb (may_start (h :: l)) (safe (h :: l)))) (nows [(0, 0)]).
    Definition accepts : bool :=
      negb (robots r =? 0)%nat && (reach r <=? window c) && (window c <=? width r) && starts_are_safe
      && Local.check nat nat nat Nat.eqb leads ends (robots r) admits good (window c) (far r) (seq 0 (colours r))
           states acts 1.

    Hypothesis accepted : accepts = true.

    Lemma parts : robots r <> O /\ reach r <= window c <= width r /\ starts_are_safe = true
      /\ Local.check nat nat nat Nat.eqb leads ends (robots r) admits good (window c) (far r) (seq 0 (colours r))
           states acts 1 = true.
    Proof.
      unfold accepts in accepted; rewrite !andb_true_iff, negb_true_iff, Nat.eqb_neq, !Z.leb_le in accepted; tauto.
    Qed.

    Lemma listed : forall s a o, In o (ends s a) -> In s states /\ In a acts.
    Proof.
      intros s a o I; unfold ends, move, states, acts, most_acts in *; rewrite !in_seq.
      destruct (Nat.lt_ge_cases s (length (moves r))) as [L|L].
      - destruct (Nat.lt_ge_cases a (length (nth s (moves r) []))) as [M|M].
        + pose proof (nth_In (moves r) [] L) as J; apply (in_map (@length _)) in J.
          assert (length (nth s (moves r) []) <= list_max (map (@length _) (moves r)))%nat as B.
          { pose proof (proj1 (list_max_le (map (@length _) (moves r)) _) (Nat.le_refl _)) as A.
            rewrite Forall_forall in A; exact (A _ J). }
          lia.
        + rewrite (nth_overflow (nth s (moves r) [])) in I by exact M; destruct I.
      - rewrite (nth_overflow (moves r)) in I by exact L; cbn in I; destruct a; destruct I.
    Qed.

    Lemma near_wider : forall v w l, v <= w -> near v l = true -> near w l = true.
    Proof.
      intros v w l L E; unfold near, Local.near in *; rewrite forallb_forall in *; intros n I; specialize (E n I).
      apply Local.within_abs in E; apply Local.within_abs; lia.
    Qed.

    Lemma in_nows : forall cells n, In (at_ n) cells -> In (is_ n) states -> (on n < colours r)%nat ->
      In n (nows cells).
    Proof.
      intros cells [d s i] D S I; cbn in *; unfold nows; apply in_flat_map; exists d; split; [exact D|].
      apply in_flat_map; exists s; split; [exact S|]; apply in_map_iff; exists i; rewrite in_seq; split; [auto | lia].
    Qed.

    Lemma start_is_safe : forall h l, length (h :: l) = robots r -> at_ h = (0, 0) ->
      Forall (fun n => In (is_ n) states /\ (on n < colours r)%nat) (h :: l) ->
      may_start (h :: l) = true -> safe (h :: l) = true.
    Proof.
      intros h l L O F M; destruct parts as [_ [W [St _]]].
      destruct (near (width r) (h :: l)) eqn:Ne.
      - unfold starts_are_safe in St; rewrite forallb_forall in St; inversion F as [|? ? [Fs Fc] Fl]; subst.
        assert (In h (nows [(0, 0)])) as Ih by (apply in_nows; [rewrite O; cbn; auto | exact Fs | exact Fc]).
        specialize (St h Ih); cbn beta in St.
        assert (implb (may_start (h :: l)) (safe (h :: l)) = true) as E.
        { apply (every_all _ _ _ (fun l => implb (may_start (h :: l)) (safe (h :: l))) St l);
            [cbn in L; rewrite <- L; reflexivity|].
          apply Forall_forall; intros n In_; rewrite Forall_forall in Fl; destruct (Fl n In_).
          apply in_nows; auto; apply Local.in_box; unfold near, Local.near in Ne; rewrite forallb_forall in Ne.
          apply Ne; cbn; auto. }
        now rewrite M in E.
      - unfold may_start in M; rewrite Ne in M; unfold safe.
        destruct (near (window c) (h :: l)) eqn:Nw; [|exact M].
        rewrite (near_wider (window c) (width r) _ (proj2 W) Nw) in Ne; discriminate.
    Qed.

    Lemma safe_keeps : forall l, safe l = true -> promises l = true.
    Proof.
      intros l E; destruct parts as [_ [W _]]; unfold safe, good in E; destruct (near (window c) l) eqn:Nw.
      - destruct (promises l); [reflexivity | discriminate].
      - unfold promises; destruct (near (reach r) l) eqn:Nr; [|exact E].
        rewrite (near_wider (reach r) (window c) _ (proj1 W) Nr) in Nw; discriminate.
    Qed.

    Theorem sound : holds.
    Proof.
      intros N layout bound start C B S past t R is I; destruct parts as [K [_ [_ D]]]; apply safe_keeps.
      assert (Local.Inv nat nat good (window c) (far r) layout bound t) as E.
      { eapply (Local.every_N nat nat nat Nat.eqb) with (colours := seq 0 (colours r)) (k := robots r);
          [apply Nat.eqb_refl | exact K | | exact B | | | exact R].
        - intros d; rewrite in_seq; specialize (C d); lia.
        - eapply (Local.check_inductive nat nat nat Nat.eqb) with (states := states) (acts := acts) (pace := 1);
            [exact K | exact listed | exact D].
        - intros s Q js J; destruct (S s Q) as [Q1 Q2], (B js J) as [L M]; specialize (Q2 js J).
          change (safe (Local.rel nat nat (map (Local.sees nat nat layout s) js)) = true).
          destruct js as [|i js]; [cbn in L; congruence|].
          unfold Local.rel in Q2 |- *; cbn [map] in Q2 |- *; apply start_is_safe.
          + cbn; rewrite !map_length; exact L.
          + cbn; destruct (fst (s i)); unfold Local.minus_cell; cbn; now rewrite !Z.sub_diag.
          + assert (forall j, (j < N)%nat -> In (snd (s j)) states /\ (layout (fst (s j)) < colours r)%nat) as A
              by (intros j Lj; split; [unfold states; rewrite in_seq; specialize (Q1 j Lj); lia | apply C]).
            rewrite Forall_forall in M.
            constructor; [cbn; apply A, M; cbn; auto|].
            apply Forall_forall; intros n J1; apply in_map_iff in J1; destruct J1 as [m [<- J1]].
            apply in_map_iff in J1; destruct J1 as [j [<- J1]]; cbn; apply A, M; cbn; auto.
          + exact Q2. }
      exact (E is I).
    Qed.
  End Check.
End Rule.
