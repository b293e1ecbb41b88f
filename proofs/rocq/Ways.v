(** MRC-11 of a path node that any messages come by, in any order. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines.
Import ListNotations.

Definition ways_after (me room : nat) : list passing -> list way := after (relay_step me room) [].

(** The messages of robot [r] to WFR [w] that name this node as their parent. *)
Definition is_carried (me w r : nat) (p : passing) : bool :=
  (pid (message p) =? me) && ((to_wfr (message p) =? w) && (sender p =? r)).
Definition carried (me w r : nat) (l : list passing) : list passing := filter (is_carried me w r) l.

(** The latest of those of the newest call. *)
Definition is_latest (l : list passing) (p : passing) : Prop :=
  exists before later, l = before ++ p :: later
  /\ (forall q, In q l -> of_call (message q) <= of_call (message p))
  /\ (forall q, In q later -> of_call (message q) < of_call (message p)).

Definition key (y : way) : nat * nat := (way_wfr y, way_robot y).

(** It has one way back for a robot and a WFR: that of the latest message of the newest call. *)
Definition kept (me : nat) (ways : list way) (l : list passing) : Prop :=
  NoDup (map key ways)
  /\ forall w r, match find (is_way w r) ways with
     | Some y => exists p, is_latest (carried me w r l) p /\ way_call y = of_call (message p) /\ came_from y = from p
     | None => carried me w r l = []
     end.

Lemma is_way_key : forall w r y, is_way w r y = true <-> key y = (w, r).
Proof.
  intros w r y; unfold is_way, key; rewrite andb_true_iff, !Nat.eqb_eq; split; [intros [-> ->] | intros [= -> ->]];
    auto.
Qed.

Lemma one_way : forall ways y, NoDup (map key ways) -> In y ways -> find (is_way (way_wfr y) (way_robot y)) ways =
  Some y.
Proof.
  intros ways y; induction ways as [|z ways IH]; cbn; intros N I; [contradiction|].
  apply NoDup_cons_iff in N; destruct N as [A N]. destruct (is_way _ _ z) eqn:E.
  - destruct I as [->|I]; [reflexivity | exfalso]. apply is_way_key in E; apply A;
      rewrite E. now apply (in_map key) in I.
  - destruct I as [->|I]; [|now apply IH]. assert (is_way (way_wfr y) (way_robot y) y = true) by now apply is_way_key.
    congruence.
Qed.

Lemma find_map : forall (A : Type) (f : A -> A) p l, (forall a, p (f a) = p a) ->
  find p (map f l) = option_map f (find p l).
Proof. intros A f p l E; induction l as [|a l IH]; cbn; [reflexivity|]. rewrite E; now destruct (p a). Qed.

Lemma find_append : forall (A : Type) p (l : list A) a,
  find p (l ++ [a]) = match find p l with Some b => Some b | None => if p a then Some a else None end.
Proof. intros A p l a; induction l as [|b l IH]; cbn; [reflexivity|]. now destruct (p b). Qed.

Lemma latest_newer : forall l p q, (forall o, In o l -> of_call (message o) <= of_call (message p)) ->
  of_call (message p) <= of_call (message q) -> is_latest (l ++ [q]) q.
Proof.
  intros l p q A L; exists l, []; repeat split; [|contradiction].
  intros o I; apply in_app_or in I; destruct I as [I|[<-|[]]]; [apply A in I; lia | lia].
Qed.

Lemma latest_older : forall l p q, is_latest l p -> of_call (message q) < of_call (message p) -> is_latest (l ++ [q]) p.
Proof.
  intros l p q [before [later [-> [A B]]]] L; exists before, (later ++ [q]); rewrite <- app_assoc; repeat split.
  - intros o I; rewrite app_assoc in I; apply in_app_or in I; destruct I as [I|[<-|[]]]; [now apply A | lia].
  - intros o I; apply in_app_or in I; destruct I as [I|[<-|[]]]; [now apply B | lia].
Qed.

(** It has room for each robot and WFR whose messages it carries. *)
Definition has_ways (me room : nat) (l : list passing) : Prop :=
  at_most room (fun k => carried me (fst k) (snd k) l <> []).

Lemma carried_snoc : forall me w r l p, carried me w r (l ++ [p]) = carried me w r l ++ if is_carried me w r p then
  [p] else [].
Proof. intros; unfold carried; now rewrite filter_app. Qed.

Lemma has_ways_before : forall me room l p, has_ways me room (l ++ [p]) -> has_ways me room l.
Proof.
  intros me room l p R k N A; apply R; [exact N|]. intros [w r] I E; apply (A _ I). rewrite carried_snoc in E.
  now apply app_eq_nil in E.
Qed.

Lemma kept_step : forall me room ways l p, has_ways me room (l ++ [p]) -> kept me ways l ->
  kept me (fst (relay_step me room ways p)) (l ++ [p]).
Proof.
  intros me room ways l p R [N K]; unfold relay_step; cbn [fst].
  destruct (pid (message p) =? me) eqn:Mine.
  2:{ split; [exact N|]. intros w r; specialize (K w r). rewrite carried_snoc. unfold is_carried; rewrite Mine; cbn.
      rewrite app_nil_r; exact K. }
  set (y := {| way_wfr := to_wfr (message p); way_call := of_call (message p); way_robot := sender p;
    came_from := from p |}).
  assert (forall w r, is_carried me w r p = is_way w r y) as Is by (intros; unfold is_carried; rewrite Mine;
    reflexivity).
  unfold keeps. set (mine := is_way (way_wfr y) (way_robot y)). destruct (existsb mine ways) eqn:X.
  - set (f := fun z => if mine z && (way_call z <=? way_call y) then y else z).
    assert (forall z, key (f z) = key z) as Key.
    { intros z; unfold f; destruct (mine z) eqn:E; cbn [andb]; [|reflexivity]. apply is_way_key in E; rewrite E.
      now destruct (_ <=? _). }
    assert (forall w r z, is_way w r (f z) = is_way w r z) as Way.
    { intros w r z; unfold is_way. specialize (Key z); unfold key in Key; now injection Key as -> ->. }
    split; [rewrite map_map; erewrite map_ext; [exact N | exact Key]|].
    intros w r; rewrite find_map by (apply Way). specialize (K w r). rewrite carried_snoc, Is.
    destruct (find (is_way w r) ways) as [z|] eqn:F; cbn [option_map].
    + destruct K as [o [D [C G]]]. apply find_some in F; destruct F as [_ F]. unfold f.
      destruct (is_way w r y) eqn:E.
      * apply is_way_key in E, F. replace (mine z) with true by (symmetry; apply is_way_key; rewrite F, <- E;
          reflexivity).
        cbn [andb]. destruct (Nat.leb_spec (way_call z) (way_call y)) as [L|L].
        -- exists p; split; [|now split]. destruct D as [b [t [D [A _]]]]. apply (latest_newer _ o);
             [exact A | rewrite <- C; exact L].
        -- exists o; split; [|now split]. apply latest_older; [exact D | rewrite <- C; exact L].
      * replace (mine z) with false; [cbn [andb]; rewrite app_nil_r; now exists o|].
        symmetry; apply not_true_is_false; intros M. apply is_way_key in M, F.
        assert (is_way w r y = true) by (apply is_way_key; rewrite <- F, M; reflexivity). congruence.
    + destruct (is_way w r y) eqn:E; [|now rewrite app_nil_r]. exfalso. apply existsb_exists in X;
        destruct X as [z [I M]].
      apply (find_none _ _ F) in I. apply is_way_key in M, E.
      assert (is_way w r z = true) by (apply is_way_key; rewrite M, <- E; reflexivity). congruence.
  - assert (~ In (key y) (map key ways)) as New.
    { intros I; apply in_map_iff in I; destruct I as [z [E I]]. assert (existsb mine ways = true); [|congruence].
      apply existsb_exists; exists z; split; [exact I | now apply is_way_key]. }
    replace (length ways <? room) with true.
    2:{ symmetry; apply Nat.ltb_lt. assert (length (key y :: map key ways) <= room) as L; [|cbn in L;
      rewrite map_length in L; exact L].
        apply R; [now constructor|]. intros k [<-|I]; rewrite carried_snoc.
        - rewrite Is; cbn [fst snd key]. replace (is_way _ _ y) with true by (symmetry; now apply is_way_key).
          intros E; apply app_eq_nil in E; destruct E; discriminate.
        - apply in_map_iff in I; destruct I as [z [<- I]]. cbn [fst snd key]. specialize (K (way_wfr z) (way_robot z)).
          rewrite (one_way _ _ N I) in K. destruct K as [o [[b [t [-> _]]] _]]. intros E; apply app_eq_nil in E;
            destruct E as [E _].
          now destruct b. }
    split.
    + rewrite map_app; cbn. apply (NoDup_Add (a := key y) (l := map key ways));
        [rewrite <- (app_nil_r (map key ways)) at 1; apply Add_app | now split].
    + intros w r; rewrite find_append, carried_snoc, Is. specialize (K w r).
      destruct (find (is_way w r) ways) as [z|] eqn:F.
      * replace (is_way w r y) with false; [now rewrite app_nil_r|]. symmetry; apply not_true_is_false; intros E.
        apply find_some in F; destruct F as [I F]. apply is_way_key in E, F. apply New; rewrite E, <- F;
          now apply in_map.
      * rewrite K; destruct (is_way w r y); [|reflexivity]. exists p; split; [|now split].
        exists [], []; repeat split; [|contradiction]. intros o [<-|[]]; lia.
Qed.

Lemma kept_always : forall me room l, has_ways me room l -> kept me (ways_after me room l) l.
Proof.
  intros me room l; induction l as [|p l IH] using rev_ind; intros R; [split; [constructor | reflexivity]|].
  unfold ways_after, after; rewrite fold_left_app; cbn [fold_left]. apply kept_step; [exact R|].
  now apply IH, (has_ways_before _ _ _ p).
Qed.

(** It sends a message that names it as the parent on to its own parent, and no other. A RESB of a robot's newest
    call goes to whom the robot's latest message of it came from; one of a robot that it has carried nothing of ends
    here. *)
Theorem MRC_11 : forall me room l,
  (forall p, snd (relay_step me room (ways_after me room l) p) =
     if pid (message p) =? me then
       Some {| to_wfr := to_wfr (message p); of_call := of_call (message p); says := says (message p); pid := own p |}
     else None)
  /\ (has_ways me room l -> forall w r,
      (exists p, is_latest (carried me w r l) p
                 /\ goes_to (ways_after me room l) w (of_call (message p)) r = Some (from p))
      \/ (carried me w r l = [] /\ forall e, goes_to (ways_after me room l) w e r = None)).
Proof.
  intros me room l; split; [reflexivity|]. intros R w r; destruct (kept_always me room l R) as [N K].
  set (ways := ways_after me room l) in *. clearbody ways. specialize (K w r). unfold goes_to.
  destruct (find (is_way w r) ways) as [y|] eqn:F; [left|right].
  - destruct K as [p [D [C G]]]; exists p; split; [exact D|]. rewrite <- C, <- G. apply find_some in F;
      destruct F as [I F].
    clear D; induction ways as [|z ways IH]; cbn; [contradiction|]. cbn in N; apply NoDup_cons_iff in N;
      destruct N as [A N].
    destruct I as [->|I]; [now rewrite F, Nat.eqb_refl|]. destruct (is_way w r z) eqn:E; [|now apply IH].
    exfalso; apply A; apply is_way_key in E, F; rewrite E, <- F; now apply in_map.
  - split; [exact K|]. intros e; destruct (find (fun y => is_way w r y && (way_call y =? e)) ways) as [z|] eqn:E;
      [exfalso | reflexivity].
    apply find_some in E; destruct E as [I E]. apply andb_true_iff in E. rewrite (find_none _ _ F z I) in E;
      now destruct E.
Qed.

(** A node that has no room for the way of robot 2 does not know who is to have its RESB. *)
Theorem without_room_breaks_MRC_11 : exists l p, is_latest (carried 7 1 2 l) p
  /\ goes_to (ways_after 7 1 l) 1 (of_call (message p)) 2 = None.
Proof.
  pose (m := {| to_wfr := 1; of_call := 1; says := Move 2; pid := 7 |}).
  exists [{| message := m; sender := 1; from := Robot 1; own := 3 |}; {| message := m; sender := 2; from := Robot 2;
    own := 3 |}],
    {| message := m; sender := 2; from := Robot 2; own := 3 |}.
  split; [|reflexivity]. exists [], []; repeat split; [|contradiction]. intros q [<-|[]]; auto.
Qed.
