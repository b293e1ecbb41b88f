(** NOTICE-3, NOTICE-5, NOTICE-6 and, of several events, NOTICE-4: k-FNF as the kernel has it,
    kernel/src/notice/node.rs, in any network, also an
    infinite one, whatever is late, lost or repeated. One event of one source; the waits of the nodes are over in any
    order, so that k = ∞ is flooding, too. SpreadTie.v compares [hears] with what the kernel's nodes make of
    NOTICEs. *)
From Coq Require Import List Bool Arith Lia.
Import ListNotations.

Inductive phase := Unaware | Waiting | Silent | Forwarded.

(** How far a node is, its parent, its hops to the source, and the senders that it has heard. *)
Record node := { stage : phase; parent : nat; hops : nat; heard : list nat }.

Definition unaware (n : nat) : node := {| stage := Unaware; parent := n; hops := 0; heard := [] |}.

(** Whether so many senders, the first among them, are enough to be silent. No [k] is k = ∞. *)
Definition are_enough (k : option nat) (senders : nat) : bool :=
  match k with Some k => k <? senders | None => false end.

(** What a NOTICE of sender [s] with hop count [h] makes of a node. A sender that it has heard before is ignored,
    and so is whatever comes when it is through with the event. *)
Definition hears (k : option nat) (x : node) (s h : nat) : node :=
  match stage x with
  | Unaware => {| stage := Waiting; parent := s; hops := S h; heard := [s] |}
  | Waiting =>
      if existsb (Nat.eqb s) (heard x) then x
      else
        let nearer := S h <? hops x in
        {| stage := if are_enough k (S (length (heard x))) then Silent else Waiting;
           parent := if nearer then s else parent x; hops := if nearer then S h else hops x; heard := s :: heard x |}
  | Silent | Forwarded => x
  end.

Definition forwards (x : node) : node :=
  {| stage := Forwarded; parent := parent x; hops := hops x; heard := heard x |}.

(** The nodes; every NOTICE ever sent, with its sender and hop count; what has come from whom to whom; and what each
    node has heard before it was through with the event, in order. *)
Record net := {
  nodes : nat -> node; sent : list (nat * nat); came : list (nat * nat); before : nat -> list (nat * nat);
}.

Definition put {A : Type} (f : nat -> A) (n : nat) (x : A) : nat -> A := fun m => if m =? n then x else f m.

Definition is_through (x : node) : bool := match stage x with Silent | Forwarded => true | Unaware | Waiting => false
  end.

Section Network.
  Variable k : option nat.
  Variable link : nat -> nat -> Prop.
  Variable source : nat.

  Definition begin : net :=
    {| nodes := put unaware source {| stage := Forwarded; parent := source; hops := 0; heard := [] |};
       sent := [(source, 0)]; came := []; before := fun _ => [] |}.

  (** Node [n] hears the NOTICE of [s] with hop count [h]; its wait is over. *)
  Definition comes (w : net) (s n h : nat) : net :=
    {| nodes := put (nodes w) n (hears k (nodes w n) s h); sent := sent w; came := (s, n) :: came w;
       before := if is_through (nodes w n) then before w else put (before w) n (before w n ++ [(s, h)]) |}.
  Definition ends (w : net) (n : nat) : net :=
    {| nodes := put (nodes w) n (forwards (nodes w n)); sent := (n, hops (nodes w n)) :: sent w;
       came := came w; before := before w |}.

  Inductive event (w : net) : net -> Prop :=
  | arrives : forall s n h, In (s, h) (sent w) -> link s n -> event w (comes w s n h)
  | expires : forall n, stage (nodes w n) = Waiting -> event w (ends w n).

  Inductive reaches : net -> Prop :=
  | at_begin : reaches begin
  | at_event : forall w w', reaches w -> event w w' -> reaches w'.

  (** Nothing is lost, and nothing more happens: whatever was sent has come to all to whom there is a link, and
      nobody waits. *)
  Definition is_over (w : net) : Prop :=
    (forall s h n, In (s, h) (sent w) -> link s n -> In (s, n) (came w)) /\ forall n, stage (nodes w n) <> Waiting.

  Inductive connected : nat -> Prop :=
  | itself : connected source
  | linked : forall a b, connected a -> link a b -> connected b.

  (** Of several NOTICEs the first with the least hop count. *)
  Definition is_nearest (l : list (nat * nat)) (s h : nat) : Prop :=
    exists first later, l = first ++ (s, h) :: later
    /\ (forall t g, In (t, g) l -> h <= g) /\ (forall t g, In (t, g) first -> h < g).

  (** ** What every event keeps *)

  (** Of a node that knows of the event, and is not the source: its parent, its hops and the senders heard. *)
  Definition hears_well (x : node) (l : list (nat * nat)) : Prop :=
    match stage x with
    | Unaware => l = []
    | Waiting | Silent | Forwarded =>
        (exists h, is_nearest l (parent x) h /\ hops x = S h) /\ forall s, In s (heard x) <-> In s (map fst l)
    end.

  Record inv (w : net) : Prop := {
    at_source : stage (nodes w source) = Forwarded;
    source_sent : In (source, 0) (sent w);
    sent_frozen : forall s h, In (s, h) (sent w) -> stage (nodes w s) = Forwarded /\ hops (nodes w s) = h;
    forwarded_sent : forall n, stage (nodes w n) = Forwarded -> In (n, hops (nodes w n)) (sent w);
    nearest : forall n, n <> source -> hears_well (nodes w n) (before w n);
    before_sent : forall n s h, In (s, h) (before w n) -> In (s, h) (sent w);
    came_known : forall s n, In (s, n) (came w) -> stage (nodes w n) <> Unaware;
    known_connected : forall n, stage (nodes w n) <> Unaware -> connected n;
    never_silent : k = None -> forall n, stage (nodes w n) <> Silent;
  }.

  Lemma put_same : forall (A : Type) (f : nat -> A) n x, put f n x n = x.
  Proof. intros; unfold put; now rewrite Nat.eqb_refl. Qed.
  Lemma put_other : forall (A : Type) (f : nat -> A) n x m, m <> n -> put f n x m = f m.
  Proof. intros A f n x m D; unfold put; apply Nat.eqb_neq in D; now rewrite D. Qed.

  Lemma nearest_more : forall l s h t g, is_nearest l s h -> h <= g -> is_nearest (l ++ [(t, g)]) s h.
  Proof.
    intros l s h t g [first [later [-> [A B]]]] L; exists first, (later ++ [(t, g)]); rewrite <- app_assoc;
      repeat split; auto.
    intros u f I; rewrite app_assoc in I; apply in_app_or in I; destruct I as [I|[[= <- <-]|[]]];
      [now apply (A u) | exact L].
  Qed.

  Lemma nearest_new : forall l s h t g, is_nearest l s h -> g < h -> is_nearest (l ++ [(t, g)]) t g.
  Proof.
    intros l s h t g [first [later [-> [A B]]]] L; exists (first ++ (s, h) :: later), []; repeat split.
    - intros u f I; apply in_app_or in I; destruct I as [I|[[= <- <-]|[]]]; [apply A in I; lia | lia].
    - intros u f I; apply A in I; lia.
  Qed.

  Lemma hears_well_step : forall x l s h, hears_well x l -> is_through x = false ->
    (In s (map fst l) -> exists g, In (s, g) l /\ g = h) -> hears_well (hears k x s h) (l ++ [(s, h)]).
  Proof.
    intros x l s h W T Again; unfold hears_well, is_through, hears in *; destruct (stage x) eqn:P; try discriminate.
    - cbn [stage]. subst l; split.
      + exists h; split; [|reflexivity]. exists [], []; repeat split; [|contradiction]. intros t g [[= <- <-]|[]]; auto.
      + reflexivity.
    - destruct W as [[f [N H]] E]. destruct (existsb (Nat.eqb s) (heard x)) eqn:X.
      + rewrite P. assert (In s (map fst l)) as I.
        { apply E. apply existsb_exists in X; destruct X as [t [X Q]]; apply Nat.eqb_eq in Q; now subst. }
        destruct (Again I) as [g [G ->]]. split.
        * exists f; split; [|exact H]. apply nearest_more; [exact N|]. destruct N as [a [b [_ [L _]]]]. now apply (L s).
        * intros t; rewrite E, map_app, in_app_iff; cbn; intuition; now subst.
      + assert (forall p, p = Waiting \/ p = Silent ->
          hears_well {| stage := p; parent := if S h <? hops x then s else parent x;
                        hops := if S h <? hops x then S h else hops x; heard := s :: heard x |} (l ++ [(s, h)])) as G.
        { intros p Q; unfold hears_well; cbn [stage parent hops heard].
          assert ((exists g, is_nearest (l ++ [(s, h)]) (if S h <? hops x then s else parent x) g
                     /\ (if S h <? hops x then S h else hops x) = S g)
                  /\ forall t, In t (s :: heard x) <-> In t (map fst (l ++ [(s, h)]))) as B.
          { split.
            - destruct (Nat.ltb_spec (S h) (hops x)) as [L|L].
              + exists h; split; [|reflexivity]. apply (nearest_new l (parent x) f); [exact N | lia].
              + exists f; split; [|exact H]. apply nearest_more; [exact N | lia].
            - intros t; rewrite map_app, in_app_iff; cbn. rewrite (E t). tauto. }
          destruct Q as [-> | ->]; exact B. }
        destruct (are_enough k _); apply G; auto.
  Qed.

  Lemma inv_always : forall w, reaches w -> inv w.
  Proof.
    intros w R; induction R as [|w w' R V E].
    - assert (forall n, n <> source -> nodes begin n = unaware n) as Un by (intros; now apply put_other).
      assert (nodes begin source = {| stage := Forwarded; parent := source; hops := 0;
        heard := [] |}) as So by apply put_same.
      constructor.
      + now rewrite So.
      + now left.
      + intros s h [[= <- <-]|[]]; now rewrite So.
      + intros n F; destruct (Nat.eq_dec n source) as [->|D]; [rewrite So; now left | rewrite (Un n D) in F;
          discriminate].
      + intros n D; now rewrite (Un n D).
      + contradiction.
      + contradiction.
      + intros n F; destruct (Nat.eq_dec n source) as [->|D]; [constructor | rewrite (Un n D) in F; now destruct F].
      + intros _ n F; destruct (Nat.eq_dec n source) as [->|D]; [rewrite So in F | rewrite (Un n D) in F]; discriminate.
    - destruct E as [s n h I L | n W].
      + assert (stage (nodes w n) <> Waiting -> is_through (nodes w n) = false -> stage (nodes w n) = Unaware) as Fresh.
        { unfold is_through; destruct (stage (nodes w n)); congruence. }
        assert (forall p, stage (hears k (nodes w n) s h) = p -> p = Forwarded \/ p = Unaware ->
          hears k (nodes w n) s h = nodes w n /\ stage (nodes w n) <> Unaware) as Same.
        { intros p P Q; unfold hears in *. destruct (stage (nodes w n)) eqn:T; try (split; congruence).
          - cbn in P; destruct Q; congruence.
          - destruct (existsb _ _); [split; congruence|]. cbn in P; destruct (are_enough k _), Q; congruence. }
        assert (forall m, stage (nodes w m) <> Unaware ->
          stage (put (nodes w) n (hears k (nodes w n) s h) m) <> Unaware) as Known.
        { intros m K; destruct (Nat.eq_dec m n) as [->|D]; [rewrite put_same | now rewrite put_other].
          intros U; destruct (Same _ U); auto. congruence. }
        assert (stage (hears k (nodes w n) s h) <> Unaware) as Knows by (intros U; destruct (Same _ U); auto;
          congruence).
        assert (is_through (nodes w n) = true -> hears k (nodes w n) s h = nodes w n) as Through.
        { unfold is_through, hears; destruct (stage (nodes w n)); congruence. }
        constructor; cbn [comes ends nodes sent came before].
        * destruct (Nat.eq_dec source n) as [<-|D]; [rewrite put_same | rewrite put_other by exact D; apply V].
          rewrite Through; [apply V|]. unfold is_through; now rewrite (at_source _ V).
        * apply V.
        * intros t g J; destruct (sent_frozen _ V _ _ J) as [F H].
          destruct (Nat.eq_dec t n) as [->|D]; [rewrite put_same | now rewrite put_other].
          rewrite Through; [now split|]. unfold is_through; now rewrite F.
        * intros m F; destruct (Nat.eq_dec m n) as [->|D];
            [rewrite put_same in * | rewrite put_other in * by exact D; now apply (forwarded_sent _ V)].
          destruct (Same _ F) as [E _]; [auto|]. rewrite E in *; now apply (forwarded_sent _ V).
        * intros m D; destruct (is_through (nodes w n)) eqn:T.
          { destruct (Nat.eq_dec m n) as [->|Dm]; [rewrite put_same, Through by reflexivity | rewrite put_other by
              exact Dm];
              now apply (nearest _ V). }
          destruct (Nat.eq_dec m n) as [->|Dm]; [rewrite !put_same | rewrite !put_other by exact Dm;
            now apply (nearest _ V)].
          apply hears_well_step; [now apply (nearest _ V) | exact T|]. intros J; apply in_map_iff in J.
          destruct J as [[t g] [E J]]; cbn in E; subst t. exists g; split; [exact J|].
          destruct (sent_frozen _ V _ _ (before_sent _ V _ _ _ J)) as [_ <-]. now destruct (sent_frozen _ V _ _ I).
        * intros m t g J; destruct (is_through (nodes w n)); [now apply (before_sent _ V m)|].
          destruct (Nat.eq_dec m n) as [->|D]; [rewrite put_same in J | rewrite put_other in J by exact D;
            now apply (before_sent _ V m)].
          apply in_app_or in J; destruct J as [J|[[= <- <-]|[]]]; [now apply (before_sent _ V n) | exact I].
        * intros t m [[= <- <-]|J]; [now rewrite put_same | apply Known; now apply (came_known _ V t)].
        * intros m K; destruct (Nat.eq_dec m n) as [->|D]; [|rewrite put_other in K by exact D;
            now apply (known_connected _ V)].
          apply (linked s); [|exact L]. apply (known_connected _ V). destruct (sent_frozen _ V _ _ I); congruence.
        * intros K m F; destruct (Nat.eq_dec m n) as [->|D];
            [rewrite put_same in F | rewrite put_other in F by exact D; now apply (never_silent _ V K m)].
          pose proof (never_silent _ V K n) as Q. unfold hears in F;
            rewrite K in F. destruct (stage (nodes w n)) eqn:T; try congruence.
          -- discriminate.
          -- destruct (existsb _ _); [congruence | discriminate].
      + assert (n <> source) as D by (intros ->; rewrite (at_source _ V) in W; discriminate).
        constructor; cbn [comes ends nodes sent came before].
        * rewrite put_other by auto; apply V.
        * right; apply V.
        * intros s h [[= <- <-]|J]; [rewrite put_same; now split|]. destruct (sent_frozen _ V _ _ J) as [F H].
          rewrite put_other; [now split | intros ->; congruence].
        * intros m F; destruct (Nat.eq_dec m n) as [->|N]; [rewrite put_same; now left|].
          rewrite put_other in * by exact N; right; now apply (forwarded_sent _ V).
        * intros m M; destruct (Nat.eq_dec m n) as [->|N]; [rewrite put_same | rewrite put_other by exact N;
            now apply (nearest _ V)].
          pose proof (nearest _ V n M) as G; unfold hears_well in *; rewrite W in G; exact G.
        * intros m t g J; right; now apply (before_sent _ V m).
        * intros t m J; destruct (Nat.eq_dec m n) as [->|N]; [rewrite put_same; discriminate|].
          rewrite put_other by exact N; now apply (came_known _ V t).
        * intros m K; destruct (Nat.eq_dec m n) as [->|N]; [apply (known_connected _ V); congruence|].
          rewrite put_other in K by exact N; now apply (known_connected _ V).
        * intros K m; destruct (Nat.eq_dec m n) as [->|N]; [rewrite put_same; discriminate|].
          rewrite put_other by exact N; now apply (never_silent _ V K).
  Qed.

  (** ** The clauses *)

  (** With k = ∞, where nothing is lost, those that links connect to the source forward the event in the end, and no
      others. *)
  Theorem NOTICE_3 : k = None -> forall w, reaches w -> is_over w ->
    forall n, stage (nodes w n) = Forwarded <-> connected n.
  Proof.
    intros K w R [All Still] n; pose proof (inv_always w R) as V; split.
    - intros F; apply (known_connected _ V); congruence.
    - intros C; induction C as [|a b C IH L]; [apply V|].
      pose proof (All a _ b (forwarded_sent _ V a IH) L) as A. pose proof (came_known _ V _ _ A) as B.
      pose proof (never_silent _ V K b) as S. pose proof (Still b) as W. destruct (stage (nodes w b)); congruence.
  Qed.

  (** With k = ∞, where nothing is lost, every node that links connect to the source receives the event. *)
  Theorem NOTICE_5 : k = None -> forall w, reaches w -> is_over w ->
    forall n, connected n -> stage (nodes w n) <> Unaware.
  Proof. intros K w R O n C; apply (NOTICE_3 K w R O) in C; congruence. Qed.

  (** With every k: of the NOTICEs that a node has heard before it forwards or falls silent, its parent is the sender of
      the first with the least hop count, and it is one hop farther. *)
  Theorem NOTICE_6 : forall w, reaches w -> forall n, n <> source -> stage (nodes w n) <> Unaware ->
    exists h, is_nearest (before w n) (parent (nodes w n)) h /\ hops (nodes w n) = S h.
  Proof.
    intros w R n D K; pose proof (nearest _ (inv_always w R) n D) as W; unfold hears_well in W.
    destruct (stage (nodes w n)); [contradiction | apply W | apply W | apply W].
  Qed.
End Network.

(** With k = 1 a node may be left out: 3 is behind 1, which hears the source 0 and 2, and is silent. *)
Definition square (a b : nat) : Prop := In (a, b) [(0, 1); (1, 0); (0, 2); (2, 0); (1, 2); (2, 1); (1, 3); (3, 1)].

Theorem k_of_one_breaks_NOTICE_5 : exists w, reaches (Some 1) square 0 w
  /\ is_over square w /\ connected square 0 3 /\ stage (nodes w 3) = Unaware.
Proof.
  assert (forall w s n h, reaches (Some 1) square 0 w -> In (s, h) (sent w) -> square s n ->
    reaches (Some 1) square 0 (comes (Some 1) w s n h)) as Hear.
  { intros w s n h R I L; eapply at_event; [exact R | now apply arrives]. }
  pose (heard_0 := comes (Some 1) (comes (Some 1) (begin 0) 0 1 0) 0 2 0).
  exists (comes (Some 1) (comes (Some 1) (ends heard_0 2) 2 1 1) 2 0 1); split; [|split; [|split]].
  - assert (reaches (Some 1) square 0 (ends heard_0 2)) as E.
    { apply at_event with (w := heard_0); [|now apply expires].
      do 2 (apply Hear; [|now left|unfold square; cbn; auto 12]). apply at_begin. }
    do 2 (apply Hear; [|now left|unfold square; cbn; auto 12]). exact E.
  - split.
    + cbn; unfold square; intros s h n I L.
      destruct I as [[= <- <-]|[[= <- <-]|[]]]; cbn in L;
        repeat (destruct L as [L|L]; [injection L as <-; auto 12 || discriminate|]); try contradiction;
        repeat (destruct L as [L|L]; [try discriminate; injection L as <-; auto 12|]); contradiction.
    + intros n; do 4 (destruct n as [|n]; [vm_compute; discriminate|]); vm_compute; discriminate.
  - apply (linked _ _ 1); [apply (linked _ _ 0); [apply itself|] |]; unfold square; cbn; auto 12.
  - reflexivity.
Qed.

(** ** NOTICE-4 *)

(** A node, the number of the latest event of its source that it has heard of, and how far it is with that one. Events
    are counted from 1. *)
Record listener := { latest : nat; with_it : node }.

Inductive happening := Comes (e s h : nat) | Waited.

(** What comes of the NOTICE of sender [s] with hop count [h] of event [e], and of the end of its wait; as published,
    too, without [numbers] of events. *)
Definition notes (numbers : bool) (k : option nat) (me : nat) (x : listener) (i : happening) : listener :=
  match i with
  | Comes e s h =>
      if (latest x <? e) && (numbers || (latest x =? 0)) then {| latest := e; with_it := hears k (unaware me) s h |}
      else if (e =? 0) || (numbers && (e <? latest x)) then x
      else {| latest := latest x; with_it := hears k (with_it x) s h |}
  | Waited =>
      match stage (with_it x) with
      | Waiting => {| latest := latest x; with_it := forwards (with_it x) |}
      | Unaware | Silent | Forwarded => x
      end
  end.

Definition after (numbers : bool) (k : option nat) (me : nat) (l : list happening) : listener :=
  fold_left (notes numbers k me) l {| latest := 0; with_it := unaware me |}.

(** The first NOTICE of an event that is newer than all of which a node has heard: the node waits, its parent is the
    sender, and from then on it is as one that has heard of no event before. *)
Theorem NOTICE_4 : forall k me before e s h, 0 < e -> (forall f t g, In (Comes f t g) before -> f < e) ->
  after true k me (before ++ [Comes e s h])
    = {| latest := e; with_it := {| stage := Waiting; parent := s; hops := S h; heard := [s] |} |}
  /\ forall later, after true k me (before ++ Comes e s h :: later) = after true k me (Comes e s h :: later).
Proof.
  intros k me before e s h P Older.
  assert (latest (after true k me before) < e) as New.
  { revert Older; induction before as [|i before IH] using rev_ind; intros Older; [exact P|].
    unfold after; rewrite fold_left_app; fold (after true k me before); cbn [fold_left].
    assert (latest (after true k me before) < e) as L.
    { apply IH; intros f t g I; apply (Older f t g), in_or_app; now left. }
    destruct i as [f t g|]; cbn [notes].
    - assert (f < e) by (apply (Older f t g), in_or_app; right; now left).
      destruct (_ && _); [assumption|]. destruct (_ || _); exact L.
    - destruct (stage _); exact L. }
  assert (forall x, latest x < e -> notes true k me x (Comes e s h)
    = {| latest := e; with_it := hears k (unaware me) s h |}) as First.
  { intros x L; cbn [notes]. apply Nat.ltb_lt in L; now rewrite L. }
  unfold after in *; split; [|intros later]; rewrite fold_left_app; cbn [fold_left]; rewrite First by exact New;
    [reflexivity | now rewrite (First {| latest := 0; with_it := unaware me |} P)].
Qed.

(** As published it is deaf to the next event when it is through with one. *)
Theorem published_breaks_NOTICE_4 : exists before, (forall f t g, In (Comes f t g) before -> f < 2)
  /\ after false None 9 (before ++ [Comes 2 1 0]) = after false None 9 before.
Proof.
  exists [Comes 1 1 0; Waited]; split; [|reflexivity]. intros f t g [[= <- _ _]|[[=]|[]]]; auto.
Qed.
