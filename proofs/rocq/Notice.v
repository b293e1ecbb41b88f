(** NOTICE-1: at every moment the parent pointers form a tree rooted at the source, each node one hop farther
    from it than its parent; after section 3.2 of [Jiang 2011]. NOTICE-2: a node forwards an event at most once.

    In every network, also an infinite one, whose nodes have any numbers; under every scheme, in every order of
    arrival and of the ends of waits, whatever is lost or repeated. A node may take any NOTICE that it hears
    while it waits, so the theorem needs neither the least hop count nor the first heard. NoticeTie.v shows that
    whatever a node of the kernel makes of a NOTICE is in [hears]. There is one event of one source. *)
From Coq Require Import Lia Bool List Arith.
Import ListNotations.

(** How far a node is, its parent, and its hops to the source. *)
Inductive phase := Unaware | Waiting | Silent | Forwarded.
Record node := { stage : phase; parent : nat; hops : nat }.

(** What a NOTICE of sender [s] with hop count [h] may make of a node: it waits, or is silent at once; one that
    waits takes it or not, and is silent or not; it is ignored. What has fallen silent or forwarded stays as it
    is. *)
Definition hears (x : node) (s h : nat) : list node :=
  let nearer next := {| stage := next; parent := s; hops := S h |} in
  match stage x with
  | Unaware => [x; nearer Waiting; nearer Silent]
  | Waiting => [x; {| stage := Silent; parent := parent x; hops := hops x |}; nearer Waiting; nearer Silent]
  | Silent | Forwarded => [x]
  end.

(** Its wait is over: it forwards, and what it says is frozen. *)
Definition forwards (x : node) : node := {| stage := Forwarded; parent := parent x; hops := hops x |}.

Section Network.
  Variable link : nat -> nat -> Prop.
  Variable source : nat.

  (** The nodes, and every NOTICE ever sent: its sender and hop count. What was sent may arrive at any time,
      over any link, any number of times, or never. *)
  Record net := { nodes : nat -> node; sent : list (nat * nat) }.

  Definition put (f : nat -> node) (n : nat) (x : node) : nat -> node := fun m => if m =? n then x else f m.

  Definition begin : net :=
    {| nodes := put (fun n => {| stage := Unaware; parent := n; hops := 0 |}) source
                    {| stage := Forwarded; parent := source; hops := 0 |};
       sent := [(source, 0)] |}.

  Inductive event (w : net) : net -> Prop :=
  | arrives : forall s n h x, In (s, h) (sent w) -> link s n -> In x (hears (nodes w n) s h) ->
      event w {| nodes := put (nodes w) n x; sent := sent w |}
  | expires : forall n, stage (nodes w n) = Waiting ->
      event w {| nodes := put (nodes w) n (forwards (nodes w n)); sent := (n, hops (nodes w n)) :: sent w |}.

  Inductive reaches_net : net -> Prop :=
  | at_begin : reaches_net begin
  | at_event : forall w w', reaches_net w -> event w w' -> reaches_net w'.

  Definition knows (w : net) (n : nat) : Prop := stage (nodes w n) <> Unaware.

  Definition inv (w : net) : Prop :=
    (stage (nodes w source) = Forwarded /\ parent (nodes w source) = source /\ hops (nodes w source) = 0)
    /\ (forall s h, In (s, h) (sent w) -> stage (nodes w s) = Forwarded /\ hops (nodes w s) = h)
    /\ (forall n, knows w n -> n <> source ->
          In (parent (nodes w n), pred (hops (nodes w n))) (sent w) /\ 1 <= hops (nodes w n) /\
            link (parent (nodes w n)) n).

  Lemma put_same : forall f n x, put f n x n = x.
  Proof. intros; unfold put; now rewrite Nat.eqb_refl. Qed.
  Lemma put_other : forall f n x m, m <> n -> put f n x m = f m.
  Proof. intros f n x m D; unfold put; apply Nat.eqb_neq in D; now rewrite D. Qed.

  Lemma inv_same : forall w f, (forall m, f m = nodes w m) -> inv w -> inv {| nodes := f; sent := sent w |}.
  Proof.
    intros w f E [I0 [I1 I2]]; unfold inv, knows; cbn [nodes sent]; split; [now rewrite E | split].
    - intros s h I; rewrite E; now apply I1.
    - intros n K D; rewrite E in *; now apply I2.
  Qed.

  Lemma inv_put : forall w n x more,
    inv w -> stage (nodes w n) <> Forwarded ->
    (forall s h, In (s, h) more -> s = n /\ stage x = Forwarded /\ hops x = h) ->
    (In (parent x, pred (hops x)) (sent w) /\ 1 <= hops x /\ link (parent x) n) ->
    inv {| nodes := put (nodes w) n x; sent := more ++ sent w |}.
  Proof.
    intros w n x more [I0 [I1 I2]] F M P.
    assert (source <> n) as SN by (intros <-; now apply F).
    repeat split; cbn; try (rewrite put_other by exact SN; apply I0).
    - apply in_app_or in H; destruct H as [H|H].
      + apply M in H; destruct H as [-> [H _]]; now rewrite put_same.
      + destruct (Nat.eq_dec s n) as [->|D]; [exfalso; apply F; eapply I1; eauto|].
        rewrite put_other by exact D; eapply I1; eauto.
    - apply in_app_or in H; destruct H as [H|H].
      + apply M in H; destruct H as [-> [_ H]]; now rewrite put_same.
      + destruct (Nat.eq_dec s n) as [->|D]; [exfalso; apply F; eapply I1; eauto|].
        rewrite put_other by exact D; eapply I1; eauto.
    - apply in_or_app; right. unfold knows in H; cbn in H.
      destruct (Nat.eq_dec n0 n) as [->|D]; [rewrite put_same; apply P|].
      rewrite put_other in * by exact D; now apply I2.
    - unfold knows in H; cbn in H.
      destruct (Nat.eq_dec n0 n) as [->|D]; [rewrite put_same; apply P|].
      rewrite put_other in * by exact D; now apply I2.
    - unfold knows in H; cbn in H.
      destruct (Nat.eq_dec n0 n) as [->|D]; [rewrite put_same; apply P|].
      rewrite put_other in * by exact D; now apply I2.
  Qed.

  Lemma inv_always : forall w, reaches_net w -> inv w.
  Proof.
    intros w R; induction R as [|w w' R I E].
    - unfold begin; repeat split; cbn; try now rewrite put_same.
      + destruct H as [[= <- <-]|[]]; now rewrite put_same.
      + destruct H as [[= <- <-]|[]]; now rewrite put_same.
      + exfalso; unfold knows in H; cbn in H; rewrite put_other in H by exact H0; now apply H.
      + exfalso; unfold knows in H; cbn in H; rewrite put_other in H by exact H0; now apply H.
      + exfalso; unfold knows in H; cbn in H; rewrite put_other in H by exact H0; now apply H.
    - assert (forall n, stage (nodes w n) = Waiting ->
        In (parent (nodes w n), pred (hops (nodes w n))) (sent w) /\ 1 <= hops (nodes w n) /\
          link (parent (nodes w n)) n) as P.
      { intros n W; apply I; [unfold knows; congruence|].
        intros ->; destruct I as [[F _] _]; congruence. }
      destruct E as [s n h x In_ L H | n W].
      + assert (inv {| nodes := put (nodes w) n (nodes w n); sent := sent w |}) as Same.
        { apply inv_same; [|exact I]. intros m; unfold put; destruct (Nat.eqb_spec m n); now subst. }
        assert (forall next, next = Waiting \/ next = Silent -> stage (nodes w n) <> Forwarded ->
          inv {| nodes := put (nodes w) n {| stage := next; parent := s; hops := S h |}; sent := sent w |}) as Nearer.
        { intros next N F. apply inv_put with (more := []); auto; [intros ? ? [] | cbn; repeat split; auto; lia]. }
        unfold hears in H; destruct (stage (nodes w n)) eqn:St; cbn in H.
        * destruct H as [<-|[<-|[<-|[]]]]; auto; apply Nearer; auto; congruence.
        * destruct H as [<-|[<-|[<-|[<-|[]]]]]; auto; try (apply Nearer; auto; congruence).
          apply inv_put with (more := []); [exact I | congruence | intros ? ? [] | cbn; apply P; exact St].
        * destruct H as [<-|[]]; exact Same.
        * destruct H as [<-|[]]; exact Same.
      + apply inv_put with (more := [(n, hops (nodes w n))]); auto; try congruence.
        * cbn; intros s h [[= <- <-]|[]]; auto.
        * cbn; auto.
  Qed.

  (** Along the parent pointers. *)
  Fixpoint ancestor (w : net) (k : nat) (n : nat) : nat :=
    match k with 0 => n | S k => ancestor w k (parent (nodes w n)) end.

  (** At every moment, of every node that knows of the event: its parent knows of it, too, has forwarded, is
      linked to it and one hop nearer; and after as many parents as it has hops stands the source, and no
      earlier. *)
  Theorem NOTICE_1 : forall w, reaches_net w -> forall n, knows w n ->
    (n <> source -> stage (nodes w (parent (nodes w n))) = Forwarded
                    /\ hops (nodes w n) = S (hops (nodes w (parent (nodes w n)))) /\ link (parent (nodes w n)) n)
    /\ ancestor w (hops (nodes w n)) n = source
    /\ (forall k, k < hops (nodes w n) -> ancestor w k n <> source).
  Proof.
    intros w R n K; pose proof (inv_always w R) as [[S0 [P0 H0]] [I1 I2]].
    assert (forall m, knows w m -> m <> source -> stage (nodes w (parent (nodes w m))) = Forwarded
                    /\ hops (nodes w m) = S (hops (nodes w (parent (nodes w m)))) /\
                      link (parent (nodes w m)) m) as One.
    { intros m Km D; destruct (I2 m Km D) as [A [B L]]; destruct (I1 _ _ A) as [F H]; repeat split; auto; lia. }
    split; [now apply One|].
    remember (hops (nodes w n)) as h eqn:E; revert n K E; induction h as [|h IH]; intros n K E; cbn.
    - destruct (Nat.eq_dec n source) as [->|D]; [split; auto; lia|].
      destruct (One n K D) as [_ [X _]]; lia.
    - assert (n <> source) as D by (intros ->; lia).
      destruct (One n K D) as [F [X _]].
      destruct (IH (parent (nodes w n))) as [A B]; [unfold knows; congruence | lia |].
      split; [exact A|]. intros [|k] Lk; cbn; [exact D|]. apply B; lia.
  Qed.

  (** A node forwards the event at most once. *)
  Theorem NOTICE_2 : forall w, reaches_net w -> NoDup (map fst (sent w)).
  Proof.
    intros w R; induction R as [|w w' R N E]; [cbn; repeat constructor; intros []|].
    destruct E as [s n h x I L H | n W]; cbn [sent]; [exact N|].
    cbn; constructor; [|exact N]. intros I; apply in_map_iff in I; destruct I as [[s h] [E I]]; cbn in E; subst s.
    destruct (inv_always w R) as [_ [I1 _]]; destruct (I1 n h I) as [F _]; congruence.
  Qed.
End Network.

(** Without the freezing, FrozenOnceForwarded: what has forwarded still takes a NOTICE with a hop count up to
    its own. *)
Definition hears_thawed (x : node) (s h : nat) : list node :=
  match stage x with
  | Forwarded => if h <=? hops x then [x; {| stage := Forwarded; parent := s; hops := S h |}] else [x]
  | Unaware | Waiting | Silent => hears x s h
  end.

Inductive reaches_thawed (link : nat -> nat -> Prop) : net -> Prop :=
| thawed_begin : reaches_thawed link (begin 0)
| thawed_arrives : forall w s n h x, reaches_thawed link w -> n <> 0 -> In (s, h) (sent w) -> link s n ->
    In x (hears_thawed (nodes w n) s h) -> reaches_thawed link {| nodes := put (nodes w) n x; sent := sent w |}
| thawed_expires : forall w n, reaches_thawed link w -> stage (nodes w n) = Waiting ->
    reaches_thawed link {| nodes := put (nodes w) n (forwards (nodes w n)); sent := (n, hops (nodes w n)) :: sent w |}.

(** Then the pointers come to form a cycle: a source 0 with two neighbours 1 and 2, linked with each other. *)
Theorem without_FrozenOnceForwarded_breaks_NOTICE_1 : exists link w,
  reaches_thawed link w /\ parent (nodes w 1) = 2 /\ parent (nodes w 2) = 1.
Proof.
  exists (fun a b => a <> b /\ a <= 2 /\ b <= 2); eexists; split; [|split].
  - apply thawed_arrives with (s := 1) (n := 2) (h := 1) (x := {| stage := Forwarded; parent := 1; hops := 2 |}).
    1: apply thawed_arrives with (s := 2) (n := 1) (h := 1) (x := {| stage := Forwarded; parent := 2; hops := 2 |}).
    1: apply thawed_expires with (n := 2).
    1: apply thawed_expires with (n := 1).
    1: apply thawed_arrives with (s := 0) (n := 2) (h := 0) (x := {| stage := Waiting; parent := 0; hops := 1 |}).
    1: apply thawed_arrives with (s := 0) (n := 1) (h := 0) (x := {| stage := Waiting; parent := 0; hops := 1 |}).
    1: apply thawed_begin.
    all: try (cbn; auto; fail); lia.
  - reflexivity.
  - reflexivity.
Qed.
