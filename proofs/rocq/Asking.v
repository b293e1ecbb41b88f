(** MRC-7 of a robot that hears anything in any order: what it asks for. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines Robots.
Import ListNotations.

(** The nearest of the calls whose SBit is clear: of the least (HC, SN). *)
Definition is_nearest (q : request) (x : robot) : Prop :=
  record_of x (about q) = Some q /\ served q = false
  /\ forall p, In p (requests x) -> served p = false -> hops q < hops p \/ (hops q = hops p /\ about q <= about p).

Lemma nearest_least : forall rl l q, nearest_call rl = true -> least_identity rl = true -> nearest rl l = Some q ->
  forall p, In p l -> served p = false -> hops q < hops p \/ (hops q = hops p /\ about q <= about p).
Proof.
  intros rl l q C L H p I S; unfold nearest in H.
  assert (forall k best, fold_left (nearer rl) k best = Some q ->
    forall p, best = Some p \/ In p k -> hops q < hops p \/ (hops q = hops p /\ about q <= about p)) as G.
  { induction k as [|r k IH]; intros best F o O; cbn in F.
    { destruct O as [O|[]]; replace o with q by congruence; auto. }
    assert (forall first, best = Some first -> exists b, nearer rl best r = Some b
      /\ (hops b < hops first \/ (hops b = hops first /\ about b <= about first))
      /\ (hops b < hops r \/ (hops b = hops r /\ about b <= about r))) as B.
    { intros first ->; cbn [nearer]; unfold is_nearer; rewrite C, L; cbn [andb].
      destruct (Nat.eqb_spec (hops first) (hops r)); cbn [negb];
        [destruct (Nat.ltb_spec (about r) (about first)) | destruct (Nat.ltb_spec (hops r) (hops first))];
        eexists; (split; [reflexivity|]); lia. }
    destruct best as [first|]; [|destruct O as [[=]|[->|O]]; [now apply (IH _ F); left | now apply (IH _ F); right]].
    destruct (B first eq_refl) as [b [E [X Y]]]. specialize (IH _ F b (or_introl E)) as Z.
    destruct O as [[= ->]|[->|O]]; [lia | lia | now apply (IH _ F); right]. }
  apply (G _ _ H). right; apply filter_In; now rewrite S.
Qed.

(** The SBit of what it asked for is set, or it has heard a newer call of the WFR. *)
Definition is_over (w e : nat) (y : robot) : Prop :=
  exists q, record_of y w = Some q /\ (served q = true \/ e < epoch q).

(** It goes on asking until that is over. As published it may be sent to a WFR for which it does not ask: MRC-8. *)
Definition goes_on (rl : rule) (w e : nat) (y : robot) : Prop :=
  (exists k, doing y = Asking w e k) \/ is_over w e y
  \/ (consent rl && still_asks rl = false /\ exists v f, doing y = Leased v f).

(** By both rules: a free robot is done with every call that it knows; what it begins to ask for is the nearest call
    whose SBit is clear; and it asks for that until the SBit is set, or it hears a newer call of the WFR. *)
Theorem MRC_7 : forall rl me room, nearest_call rl = true -> least_identity rl = true -> forall ins i,
  let x := robot_after rl me room ins in let y := fst (robot_step rl me room x i) in
  (doing y = Free -> forall q, In q (requests y) -> served q = true)
  /\ (forall w e k, doing y = Asking w e k -> (forall k, doing x <> Asking w e k) ->
      exists q, is_nearest q y /\ about q = w /\ epoch q = e)
  /\ (forall w e k, doing x = Asking w e k -> goes_on rl w e y).
Proof.
  intros rl me room C L ins i x y; pose proof (inv_always rl me room ins : inv rl x) as V.
  pose proof (inv_step rl me room x i V : inv rl y) as W. clearbody x.
  split; [apply W|].
  (* whatever it becomes before it may ask, it asks for the nearest *)
  assert (forall z, y = fst (asks rl z) -> NoDup (map about (requests z)) ->
    (forall w e k, doing z = Asking w e k -> exists k, doing x = Asking w e k) ->
    (forall w e k, doing x = Asking w e k -> (exists k, doing z = Asking w e k) \/ is_over w e z) ->
    (forall w e k, doing y = Asking w e k -> (forall k, doing x <> Asking w e k) ->
      exists q, is_nearest q y /\ about q = w /\ epoch q = e)
    /\ (forall w e k, doing x = Asking w e k -> goes_on rl w e y)) as Z.
  { intros z Y N Old Keep. unfold asks in Y; destruct (doing z) as [|v f j|v f] eqn:D; cbn [fst] in Y.
    2,3: rewrite Y in *; (split; [intros w e k A B; rewrite D in A; destruct (Old w e k) as [k' K];
      [congruence | now apply B in K]|]);
         intros w e k A; unfold goes_on; rewrite D; destruct (Keep w e k A); auto.
    assert (forall w e k, doing x = Asking w e k -> is_over w e z) as Over.
    { intros w e k A; destruct (Keep w e k A) as [[k' K]|K]; [discriminate | exact K]. }
    destruct (nearest rl (requests z)) as [q|] eqn:Q; cbn [fst] in Y; rewrite Y; cbn [doing requests].
    - split.
      + intros w e k [= <- <- <-] _; exists q; repeat split; cbn [requests].
        * unfold record_of; cbn [requests]; apply one_record; [exact N | now apply nearest_in in Q].
        * now apply nearest_in in Q.
        * now apply (nearest_least rl).
      + intros w e k A; right; left; exact (Over w e k A).
    - split; [rewrite D; discriminate|]. intros w e k A; right; left; exact (Over w e k A). }
  assert (y = x -> (forall w e k, doing y = Asking w e k -> (forall k, doing x <> Asking w e k) ->
      exists q, is_nearest q y /\ about q = w /\ epoch q = e)
    /\ (forall w e k, doing x = Asking w e k -> goes_on rl w e y)) as Same.
  { intros ->; split; [intros w e k A B; now apply B in A | intros w e k A; left; eauto]. }
  destruct i as [w e h s|w e to c| | |w e]; cbn [robot_step] in y.
  - apply (Z _ eq_refl); [now apply notes_once, V | |].
    + intros v f k D; unfold notes in D; cbn [about epoch] in D; destruct (record_of x w); cbn [doing] in D; [|eauto].
      destruct (_ && _); [discriminate | eauto].
    + intros v f k D; unfold notes; cbn [about]. destruct (record_of x w) as [p|] eqn:R; cbn [doing]; [|left; eauto].
      cbn [epoch]. destruct (epochs rl && (epoch p <? e) && is_own (doing x) w) eqn:T; [|left; eauto].
      right. apply andb_true_iff in T; destruct T as [T O]. rewrite D in O; cbn in O; apply Nat.eqb_eq in O; subst v.
      exists {| about := w; epoch := e; served := false; hops := S h; parent := s |}.
      unfold record_of in *; cbn [requests about]. rewrite find_change by (intros; now apply about_noted).
      rewrite Nat.eqb_refl, R; cbn [option_map]. unfold noted; cbn [epoch]; rewrite T. split; [reflexivity|right].
      destruct (asks_open _ _ V w f k D) as [q [Q [_ E]]]. unfold record_of in Q; rewrite R in Q; injection Q as ->.
      apply andb_true_iff in T; destruct T as [T G]. apply Nat.ltb_lt in G; rewrite (E T) in G; exact G.
  - destruct (to =? me); [|now apply Same]. unfold heeds in y. destruct (record_of x w) as [q|] eqn:R;
      [|now apply Same].
    destruct (epochs rl && negb (epoch q =? e)); [now apply Same|].
    assert (forall l, record_of {| requests := serve w (requests x); doing := l |} w = Some (set_bit q)) as Bit.
    { intros l; unfold record_of in *; cbn [requests]; now rewrite serve_record, Nat.eqb_refl, R. }
    destruct (match c with Some c => c =? me | None => false end).
    + subst y; cbn [fst doing requests]; split.
      * destruct (_ || _ || _); [discriminate|]. intros v f k A B; now apply B in A.
      * intros v f k D; unfold goes_on; cbn [doing]; rewrite D. destruct (Nat.eqb_spec v w) as [->|N].
        { right; left; exists (set_bit q); split; [apply Bit | now left]. }
        cbn [negb andb orb]. destruct (still_asks rl), (consent rl); cbn [negb andb orb]; eauto 6.
    + apply (Z _ eq_refl); cbn [requests doing]; [now rewrite serve_about; apply V | |].
      * intros v f k D; destruct (_ || _); [discriminate | eauto].
      * intros v f k D; rewrite D. destruct (Nat.eqb_spec v w) as [->|N]; cbn;
          [right; exists (set_bit q); split; [apply Bit | now left] | left; eauto].
  - destruct (doing x) as [|w e [|k]|] eqn:D; try (now apply Same); destruct (repetition rl); try (now apply Same).
    + apply (Z _ eq_refl); cbn [requests doing]; [now rewrite serve_about; apply V | discriminate|].
      intros v f k [= <- <- <-]; right. destruct (asks_open _ _ V _ _ _ D) as [q [Q _]]; exists (set_bit q).
      unfold record_of in *; cbn [requests]; rewrite serve_record, Nat.eqb_refl, Q; cbn; auto.
    + subst y; cbn [fst doing requests]; split; [intros v f j [= <- <- <-] B; now destruct (B (S k))|].
      intros v f j [= <- <- <-]; left; eexists; reflexivity.
  - destruct (doing x) eqn:D; apply (Z _ eq_refl); try apply V; cbn [doing]; try discriminate; rewrite ?D; eauto;
      discriminate.
  - destruct (doing x) eqn:D; try (now apply Same). destruct (_ && _); [|now apply Same].
    apply (Z _ eq_refl); [apply V | discriminate | discriminate].
Qed.

(** ** What each condition is needed for *)

(** WFR 2 calls, then WFR 1, then WFR 2 anew; a robot that is told nothing asks for the nearer of the two. *)
Definition calls_from (one two : nat) : list robot_input := [Notice 2 1 two 5; Notice 1 1 one 5; Notice 2 2 two 5].

Theorem each_condition_is_needed_for_MRC_7 :
  Forall (fun case => let y := robot_after (fst case) 1 9 (snd case) in
            exists q p, doing y = Asking (about q) (epoch q) 1 /\ record_of y (about q) = Some q
            /\ In p (requests y) /\ served p = false
            /\ (hops p < hops q \/ (hops p = hops q /\ about p < about q)))
    [(without_NearestCall, calls_from 3 1); (without_LeastIdentity, calls_from 2 2)].
Proof.
  apply Forall_cons; [|apply Forall_cons; [|constructor]]; cbn [fst snd].
  - exists {| about := 1; epoch := 1; served := false; hops := 4; parent := 5 |},
      {| about := 2; epoch := 2; served := false; hops := 2; parent := 5 |}.
    repeat split; vm_compute; auto.
  - exists {| about := 2; epoch := 2; served := false; hops := 3; parent := 5 |},
      {| about := 1; epoch := 1; served := false; hops := 3; parent := 5 |}.
    repeat split; vm_compute; auto.
Qed.
