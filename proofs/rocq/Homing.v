(** TAN-1 and TAN-2: a robot on its way through a tree, as kernel/src/tan/homing.rs has it, that hears any signals in
    any order, of any nodes in any trees. TAN-4: a node that guides robots. Where nodes are, and how strong they are
      heard, is left out: [outcomes] has
    whatever a measurement may bring about. HomingTie.v shows that what the kernel's robots do is in these lists. *)
From Coq Require Import List Bool Arith Lia.
Import ListNotations.

(** A path node's signal: the WFR that is the root of the tree, the node, its hops from the WFR, and its parent. *)
Record nav := { root : nat; node : nat; far : nat; above : nat }.

Inductive stage := Asks (n : nat) | Scans (v : nav) | Walks (v : nav) | Arrived | Lost.

(** Its hops from the WFR, the node where it was last, with that one's hops, and how far it has come. *)
Record homing := { hops : nat; last : option (nat * nat); at_stage : stage }.

Inductive input := Hears (v : nav) | Measures | Bumps | Waited.

Section Robot.
  (** The WFR to which it goes. *)
  Variable goal : nat.

  Definition now (x : homing) (s : stage) : homing := {| hops := hops x; last := last x; at_stage := s |}.

  (** It has come to the node that signals. *)
  Definition comes (v : nav) : homing :=
    {| hops := far v; last := Some (node v, far v); at_stage := if far v =? 0 then Arrived else Asks (above v) |}.

  (** It does not hear the node: it asks again, or the node before, or is lost. *)
  Definition again (x : homing) (n : nat) : list homing :=
    now x (Asks n) :: now x Lost ::
    match last x with
    | Some (l, h) => if l =? n then [] else [{| hops := S h; last := last x; at_stage := Asks l |}]
    | None => []
    end.

  Definition is_followed (x : homing) (n : nat) (v : nav) : bool :=
    (node v =? n) && (root v =? goal) && (S (far v) =? hops x).

  Definition outcomes (x : homing) (i : input) : list homing :=
    match i, at_stage x with
    | Hears v, Asks n => [if is_followed x n v then now x (Scans v) else x]
    | Measures, Scans v => x :: comes v :: now x (Walks v) :: again x (node v)
    | Measures, Walks v => x :: comes v :: now x (Scans v) :: again x (node v)
    | Bumps, Walks v => [now x (Scans v)]
    | Waited, Asks n => again x n
    | _, _ => [x]
    end.

  (** In the tree of a WFR that alone has no hops. *)
  Definition is_honest (v : nav) : Prop := far v = 0 <-> node v = root v.

  (** It sets out towards its parent; [such] signals may be heard. *)
  Inductive reached (such : nav -> Prop) : homing -> Prop :=
  | sets_out : forall parent h, reached such {| hops := h; last := None; at_stage := Asks parent |}
  | goes_on : forall x i y, reached such x -> (forall v, i = Hears v -> such v) -> In y (outcomes x i) -> reached such
    y.

  Definition follows (x : homing) (v : nav) : Prop := at_stage x = Scans v \/ at_stage x = Walks v.

  (** Whom it follows is one hop nearer in the tree of its WFR, and was heard; and where it was last it is, or one hop
      farther. *)
  Record inv (such : nav -> Prop) (x : homing) : Prop := {
    followed : forall v, follows x v -> root v = goal /\ S (far v) = hops x /\ such v;
    where_last : forall n h, last x = Some (n, h) -> hops x = h \/ hops x = S h;
  }.

  Lemma inv_again : forall such x n y, inv such x -> In y (again x n) -> inv such y.
  Proof.
    intros such x n y [F L] I; unfold again in I; destruct I as [<-|[<-|I]].
    1,2: constructor; [intros v [E|E]; discriminate | exact L].
    destruct (last x) as [[l h]|]; [|contradiction]. destruct (l =? n); [contradiction|]. destruct I as [<-|[]].
    constructor; [intros v [E|E]; discriminate | cbn; intros m g [= <- <-]; auto].
  Qed.

  Lemma inv_comes : forall such v, inv such (comes v).
  Proof.
    intros such v; constructor; unfold follows, comes; cbn; [|intros n h [= <- <-]; auto].
    intros u; destruct (far v =? 0); intros [E|E]; discriminate.
  Qed.

  Lemma inv_now : forall such x v s, inv such x -> follows x v -> s = Scans v \/ s = Walks v -> inv such (now x s).
  Proof.
    intros such x v s [F L] E S; constructor; [|exact L]. intros u U; specialize (F v E); cbn.
    assert (u = v) as ->; [|exact F]. unfold follows, now in U; cbn in U; destruct S as [-> | ->], U; congruence.
  Qed.

  Lemma inv_always : forall such x, reached such x -> inv such x.
  Proof.
    intros such x R; induction R as [parent h|x i y R V A I].
    - constructor; [intros v [E|E]; discriminate | discriminate].
    - unfold outcomes in I.
      destruct i as [v| | |], (at_stage x) as [n|u|u| |] eqn:S; try (destruct I as [<-|[]]; exact V);
        try (now apply (inv_again _ x n));
        try (destruct I as [<-|[<-|[<-|I]]]; [exact V | apply inv_comes | | now apply (inv_again _ x (node u))];
             apply (inv_now _ _ u); unfold follows; auto).
      + destruct I as [<-|[]]. destruct (is_followed x n v) eqn:E; [|exact V]. unfold is_followed in E.
        rewrite !andb_true_iff, !Nat.eqb_eq in E; destruct E as [[E1 E2] E3]. constructor; [|apply V].
        intros w [W|W]; [|discriminate]. cbn in W; injection W as <-. repeat split; auto.
      + destruct I as [<-|[]]. apply (inv_now _ _ u); unfold follows; auto.
  Qed.

  (** A robot that asks a node follows the signal that it hears if it is that node's, one hop nearer than itself in the
      tree of its WFR, and no other; so whatever it follows is so, and it begins to follow only what it asked. *)
  Theorem TAN_1 : forall such x, reached such x ->
    (forall n v y, at_stage x = Asks n -> In y (outcomes x (Hears v)) ->
       (follows y v <-> node v = n /\ root v = goal /\ S (far v) = hops x))
    /\ (forall v, follows x v -> root v = goal /\ S (far v) = hops x)
    /\ (forall i y v, In y (outcomes x i) -> follows y v -> follows x v \/ (i = Hears v /\ at_stage x = Asks (node v))).
  Proof.
    intros such x R; pose proof (inv_always such x R) as V; split; [|split].
    - intros n v y S I; unfold outcomes in I; rewrite S in I; destruct I as [<-|[]]. unfold is_followed.
      destruct (Nat.eqb_spec (node v) n), (Nat.eqb_spec (root v) goal), (Nat.eqb_spec (Datatypes.S (far v)) (hops x));
        cbn [andb];
        (split; [intros [E|E]; cbn in E; try congruence; auto | intros [A [B C]]; try contradiction; left;
          reflexivity]).
    - intros v F; destruct (followed _ _ V v F) as [A [B _]]; auto.
    - intros i y v I F; unfold outcomes in I.
      assert (forall n, In y (again x n) -> False) as NoAgain.
      { intros n J; unfold again in J; destruct J as [<-|[<-|J]]; [destruct F; discriminate | destruct F;
          discriminate|].
        destruct (last x) as [[l h]|]; [|contradiction]. destruct (l =? n); [contradiction|].
        destruct J as [<-|[]]; destruct F; discriminate. }
      assert (forall u, y = comes u -> False) as NoComes.
      { intros u ->; unfold follows, comes in F; cbn in F; destruct (far u =? 0), F; discriminate. }
      destruct i as [u| | |], (at_stage x) as [n|u'|u'| |] eqn:S; try (destruct I as [<-|[]]; auto; fail);
        try (exfalso; eapply NoAgain; exact I);
        try (destruct I as [<-|[E|[<-|I]]]; [auto | exfalso; eapply NoComes; eauto | | exfalso; eapply NoAgain;
          exact I];
             left; unfold follows in *; rewrite S; destruct F as [F|F]; cbn in F; try discriminate; injection F as <-;
               auto).
      + destruct I as [<-|[]]. destruct (is_followed x n u) eqn:E; [|auto]. destruct F as [F|F]; [|discriminate].
        cbn in F; injection F as <-. right; split; [reflexivity|]. unfold is_followed in E.
        rewrite !andb_true_iff, !Nat.eqb_eq in E. destruct E as [[-> _] _]; reflexivity.
      + destruct I as [<-|[]]. left; unfold follows in *; rewrite S; destruct F as [F|F]; cbn in F; try discriminate.
        injection F as <-; auto.
  Qed.

  (** A robot that follows a node and is then as far from the WFR as the node has come to it: it has arrived if the node
      is its WFR, and asks the node's parent next if not. It arrives nowhere else. *)
  Theorem TAN_2 : forall x, reached is_honest x -> forall i y, In y (outcomes x i) ->
    (forall v, follows x v -> hops y = far v ->
       at_stage y = if node v =? goal then Arrived else Asks (above v))
    /\ (at_stage y = Arrived -> at_stage x <> Arrived -> exists v, follows x v /\ node v = goal).
  Proof.
    intros x R i y I; pose proof (inv_always _ x R) as V.
    assert (forall v, follows x v -> (far v =? 0) = (node v =? goal)) as Root.
    { intros v F; destruct (followed _ _ V v F) as [<- [_ H]]; unfold is_honest in H.
      destruct (Nat.eqb_spec (far v) 0), (Nat.eqb_spec (node v) (root v)); tauto. }
    assert (forall v, follows x v -> y = x \/ y = comes v \/ hops y = hops x /\ at_stage y <> Arrived
              \/ exists l h, last x = Some (l, h) /\ hops y = S h /\ at_stage y <> Arrived) as Step.
    { intros v F; unfold outcomes in I.
      assert (forall n, In y (again x n) -> hops y = hops x /\ at_stage y <> Arrived
              \/ exists l h, last x = Some (l, h) /\ hops y = S h /\ at_stage y <> Arrived) as Ag.
      { intros n J; unfold again in J; destruct J as [<-|[<-|J]]; [left; split; [reflexivity | discriminate]..|].
        destruct (last x) as [[l h]|]; [|contradiction]. destruct (l =? n); [contradiction|]. destruct J as [<-|[]].
        right; exists l, h; repeat split; discriminate. }
      destruct F as [S|S]; rewrite S in I; destruct i; try (destruct I as [<-|[]]; auto; fail).
      - destruct I as [<-|[<-|[<-|I]]]; auto; [right; right; left; split; [reflexivity | discriminate] | right; right;
          eapply Ag; exact I].
      - destruct I as [<-|[<-|[<-|I]]]; auto; [right; right; left; split; [reflexivity | discriminate] | right; right;
          eapply Ag; exact I].
      - destruct I as [<-|[]]. right; right; left; split; [reflexivity | discriminate]. }
    split.
    - intros v F H; destruct (followed _ _ V v F) as [_ [Far _]].
      destruct (Step v F) as [->|[->|[[E _]|[l [h [L [E _]]]]]]]; [lia | | lia |].
      + unfold comes; cbn. now rewrite (Root v F).
      + destruct (where_last _ _ V l h L); lia.
    - intros A B.
      assert ((exists v, follows x v) \/ at_stage y <> Arrived) as [[v F]|N]; [|exists v; split;
        [exact F|]|contradiction].
      + unfold outcomes in I. destruct (at_stage x) as [n|v|v| |] eqn:S; try (left; exists v; unfold follows; auto;
          fail); try congruence.
        * right. destruct i; try (destruct I as [<-|[]]; try destruct (is_followed _ _ _); cbn; congruence).
          unfold again in I; destruct I as [<-|[<-|I]]; try discriminate. destruct (last x) as [[l h]|];
            [|contradiction].
          destruct (l =? n); [contradiction|]. destruct I as [<-|[]]; discriminate.
        * right. destruct i; destruct I as [<-|[]]; congruence.
      + destruct (Step v F) as [->|[->|[[_ C]|[l [h [_ [_ C]]]]]]]; try contradiction.
        unfold comes in A; cbn in A. rewrite (Root v F) in A. destruct (Nat.eqb_spec (node v) goal);
          [assumption | discriminate].
  Qed.
End Robot.

(** A node that says it has no hops and is not the WFR would be taken for it. *)
Theorem a_liar_breaks_TAN_2 : exists x y v, reached 0 (fun _ => True) x /\ In y (outcomes 0 x Measures)
  /\ follows x v /\ node v <> 0 /\ at_stage y = Arrived.
Proof.
  pose (v := {| root := 0; node := 1; far := 0; above := 2 |}).
  exists {| hops := 1; last := None; at_stage := Scans v |}, (comes v), v; repeat split; try discriminate.
  - apply goes_on with (x := {| hops := 1; last := None; at_stage := Asks 1 |}) (i := Hears v);
      [apply sets_out | auto | now left].
  - right; now left.
  - now left.
Qed.

(** ** TAN-4 *)

(** A node that guides. [Requested w n own]: a robot asks node [n] for the way to WFR [w], in whose tree this node has
    the place [own], if it has one. [Passes]: T_x has passed. *)
Inductive conduct := Idle | Signals (v : nav) | KeepsSilent.
Inductive guide_input := Requested (w n : nat) (own : option nav) | Overhears | Passes.

Section Guide.
  (** Its number. *)
  Variable me : nat.

  (** The place under which it is asked. *)
  Definition asked (i : guide_input) : option nav :=
    match i with
    | Requested w n (Some v) => if (n =? me) && (node v =? me) && (root v =? w) then Some v else None
    | Requested _ _ None | Overhears | Passes => None
    end.

  Definition guide_step (x : conduct) (i : guide_input) : conduct :=
    match i, asked i, x with
    | Passes, _, _ => Idle
    | _, Some v, (Idle | Signals _) => Signals v
    | _, Some _, KeepsSilent => KeepsSilent
    | _, None, Signals v => Signals v
    | _, None, (Idle | KeepsSilent) => KeepsSilent
    end.

  Definition guide_after (l : list guide_input) : conduct := fold_left guide_step l Idle.

  (** The last place under which it was asked. *)
  Definition asked_last (l : list guide_input) (v : nav) : Prop :=
    exists before i later, l = before ++ i :: later /\ asked i = Some v /\ forall j, In j later -> asked j = None.

  (** Since T_x has passed: a node that nobody has asked, nor made to keep silent, is idle; one that was asked first
      signals, as it was asked last; and one that had to keep silent first keeps silent. *)
  Theorem TAN_4 : forall before since, before = [] \/ (exists l, before = l ++ [Passes]) -> ~ In Passes since ->
    match since with
    | [] => guide_after (before ++ since) = Idle
    | i :: _ =>
        match asked i with
        | Some _ => exists v, guide_after (before ++ since) = Signals v /\ asked_last since v
        | None => guide_after (before ++ since) = KeepsSilent
        end
    end.
  Proof.
    intros before since B N.
    assert (guide_after (before ++ since) = guide_after since) as ->.
    { unfold guide_after; rewrite fold_left_app; f_equal. destruct B as [->|[l ->]]; [reflexivity|].
      now rewrite fold_left_app. }
    clear before B; induction since as [|j since IH] using rev_ind; [reflexivity|].
    assert (~ In Passes since /\ j <> Passes) as [N' J].
    { split; [intros I; apply N, in_or_app; now left | intros ->; apply N, in_or_app; right; now left]. }
    specialize (IH N'). unfold guide_after in *; rewrite fold_left_app; cbn [fold_left].
    destruct since as [|i since]; cbn [app] in *.
    - cbn [fold_left]. destruct (asked j) as [v|] eqn:A.
      + exists v; split; [unfold guide_step; destruct j; rewrite ?A; (reflexivity || congruence || discriminate)|].
        exists [], j, []; repeat split; [exact A | intros i []].
      + unfold guide_step; destruct j; rewrite ?A; (reflexivity || congruence || discriminate).
    - destruct (asked i).
      + destruct IH as [v [-> [before [m [later [E [A L]]]]]]]. destruct (asked j) as [u|] eqn:U.
        * exists u; split; [unfold guide_step; destruct j; rewrite ?U; (reflexivity || congruence || discriminate)|].
          exists (i :: since), j, []; repeat split; [exact U | intros g []].
        * exists v; split; [unfold guide_step; destruct j; rewrite ?U; (reflexivity || congruence || discriminate)|].
          exists before, m, (later ++ [j]); rewrite app_comm_cons, E, <- app_assoc; repeat split; [exact A|].
          intros g I; apply in_app_or in I; destruct I as [I|[<-|[]]]; auto.
      + rewrite IH; unfold guide_step. destruct j as [w n own| |]; [destruct (asked (Requested w n own)) | |];
        (reflexivity || congruence).
  Qed.
End Guide.
