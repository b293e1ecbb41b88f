(** MRC-7 and MRC-13 of a robot, and MRC-13 of a WFR, that hear anything in any order: what a robot asks for, and how
    often what nobody answers is repeated. *)
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

(** ** MRC-13 *)

(** Robot [me] is not told whom WFR [w] has chosen for its call [e], and hears no newer call of that WFR. *)
Definition leaves_asking (me w e : nat) (i : robot_input) : Prop :=
  match i with
  | Tells v f to _ => ~ (v = w /\ f = e /\ to = me)
  | Notice v f _ _ => v = w -> f <= e
  | Waited | Arrives | Lapses _ _ => True
  end.

(** Robot [r] neither accepts nor declines the call [e] of WFR [me], and no robot comes. *)
Definition leaves_offer (me e r : nat) (i : wfr_input) : Prop :=
  match i with
  | Says v f q Accept | Says v f q Decline => ~ (v = me /\ f = e /\ q = r)
  | Reached => False
  | Says _ _ _ (Move _) | Raised | Expires => True
  end.

(** How often the timer has gone off. *)
Definition waits (l : list robot_input) : nat := length (filter (fun i => match i with Waited => true | _ => false end)
  l).
Definition expiries (l : list wfr_input) : nat := length (filter (fun i => match i with Expires => true | _ => false
  end) l).

Definition moves_for (w : nat) (out : option upward) : Prop := exists m h, out = Some m /\ to_wfr m = w /\ says m =
  Move h.

Lemma asks_busy : forall rl x w e k, doing x = Asking w e k -> asks rl x = (x, None).
Proof. intros rl x w e k D; unfold asks; now rewrite D. Qed.

(** While nobody answers it asks on; at its timer it repeats its MOVE, and sends none else for that WFR. *)
Lemma asks_on : forall n me room x w e k i, inv (repeating n) x -> doing x = Asking w e k -> leaves_asking me w e i ->
  i <> Waited -> doing (fst (robot_step (repeating n) me room x i)) = Asking w e k
  /\ ~ moves_for w (snd (robot_step (repeating n) me room x i)).
Proof.
  intros n me room x w e k i V D Q N. destruct (asks_open _ _ V _ _ _ D) as [q [R [_ E]]]; specialize (E eq_refl).
  assert (~ moves_for w None) as Silent by (intros [m [h [[=] _]]]).
  destruct i as [v f h s|v f to c| | |v f]; cbn [robot_step leaves_asking] in *; try congruence.
  - assert (doing (notes (repeating n) room x {| about := v; epoch := f; served := false; hops := S h; parent := s |})
      = Asking w e k) as B.
    { unfold notes; cbn [about epoch]. destruct (record_of x v) as [p|] eqn:P; cbn [doing]; [|exact D].
      rewrite D; cbn [is_own]. destruct (Nat.eqb_spec w v) as [<-|M]; [|now rewrite andb_false_r].
      rewrite R in P; injection P as <-. specialize (Q eq_refl).
      replace (epoch q <? f) with false by (symmetry; apply Nat.ltb_ge; lia). now rewrite andb_false_r. }
    rewrite (asks_busy _ _ _ _ _ B); cbn [fst snd]; now split.
  - destruct (Nat.eqb_spec to me) as [->|]; [|now split]. unfold heeds.
    destruct (record_of x v) as [p|] eqn:P; [|now split]. cbn [epochs repeating andb].
    destruct (Nat.eqb_spec (epoch p) f) as [F|]; cbn [negb]; [|now split].
    assert (w <> v) as M by (intros <-; apply Q; rewrite R in P; injection P as <-; repeat split; congruence).
    rewrite D. destruct (Nat.eqb_spec w v) as [|_]; [contradiction|]. cbn [still_asks consent repeating negb andb orb].
    destruct (match c with Some c => c =? me | None => false end); cbn [fst snd doing].
    + split; [reflexivity|]. intros [m [h [[= <-] [_ S]]]]; discriminate.
    + erewrite asks_busy by reflexivity; now split.
  - rewrite D, (asks_busy _ _ _ _ _ D); now split.
  - rewrite D; now split.
Qed.

Lemma asks_for : forall n me room x w e k, inv (repeating n) x -> doing x = Asking w e k ->
  let y := robot_step (repeating n) me room x Waited in
  match k with
  | S k => doing (fst y) = Asking w e k /\ exists q, record_of x w = Some q /\ epoch q = e /\ snd y = Some (bids q)
  | 0 => ~ moves_for w (snd y) /\ exists q, record_of (fst y) w = Some q /\ epoch q = e /\ served q = true
  end.
Proof.
  intros n me room x w e k V D. destruct (asks_open _ _ V _ _ _ D) as [q [R [_ E]]]; specialize (E eq_refl).
  cbn [robot_step]; rewrite D; cbn [repetition repeating]. destruct k as [|k]; cbn zeta.
  - set (z := {| requests := serve w (requests x); doing := Free |}).
    assert (record_of z w = Some (set_bit q)) as Z.
    { unfold record_of in *; cbn [requests z]. now rewrite serve_record, Nat.eqb_refl, R. }
    split; [|exists (set_bit q); unfold record_of; rewrite asks_requests; now repeat split].
    intros [m [h [O [W _]]]]. unfold asks in O; cbn [doing z] in O.
    destruct (nearest (repeating n) (requests z)) as [p|] eqn:P; [|discriminate]. injection O as <-; cbn in W.
    apply nearest_in in P; destruct P as [I U]. unfold record_of in Z; rewrite <- W in Z.
    rewrite one_record in Z; [injection Z as ->; discriminate | cbn [requests z]; rewrite serve_about; apply V | exact
      I].
  - split; [reflexivity|]. exists q; rewrite R; now repeat split.
Qed.

Lemma asks_long : forall n me room w e later x k, inv (repeating n) x -> doing x = Asking w e k ->
  Forall (leaves_asking me w e) later -> waits later <= k ->
  inv (repeating n) (after (robot_step (repeating n) me room) x later)
  /\ doing (after (robot_step (repeating n) me room) x later) = Asking w e (k - waits later).
Proof.
  intros n me room w e later; induction later as [|i later IH]; intros x k V D F L;
    [cbn; split; [exact V | now rewrite Nat.sub_0_r]|].
  apply Forall_cons_iff in F; destruct F as [Q F]. pose proof (inv_step (repeating n) me room x i V) as V'.
  assert (i = Waited \/ i <> Waited) as [->|N] by (destruct i; (now left) || (right; discriminate)).
  - cbn in L; destruct k as [|k]; [lia|]. pose proof (asks_for n me room x w e _ V D) as [D' _].
    unfold after in *; cbn [fold_left]. destruct (IH _ k V' D' F) as [A B]; [unfold waits; lia|]. now split.
  - destruct (asks_on n me room x w e k i V D Q N) as [D' _].
    assert (waits (i :: later) = waits later) as W by (destruct i; (reflexivity || contradiction)).
    rewrite W in *; unfold after in *; cbn [fold_left]. now apply IH.
Qed.

(** A WFR that has offered its call to robot [mid c]. *)
Lemma offers_on : forall n me room x c k i, stage x = Offered c k -> leaves_offer me (call x) (mid c) i ->
  let y := wfr_step (repeating n) me room x i in
  match i, k with
  | Expires, S k => stage (fst y) = Offered c k /\ call (fst y) = call x
      /\ snd y = [Resb (call x) (mid c) (Some (mid c))]
  | Expires, 0 => snd y = [Calls (S (call x))]
  | _, _ => stage (fst y) = Offered c k /\ call (fst y) = call x
      /\ forall e, In (Resb e (mid c) (Some (mid c))) (snd y) -> exists h, i = Says me (call x) (mid c) (Move h)
  end.
Proof.
  intros n me room x c k i S Q y; subst y. destruct i as [|v f r [h| |]| |]; cbn [wfr_step leaves_offer] in *; try
    contradiction.
  - rewrite S; cbn; repeat split; auto; contradiction.
  - cbn [epochs repeating negb]; rewrite orb_false_r. destruct (Nat.eqb_spec v me) as [->|], (Nat.eqb_spec f (call x))
    as [->|];
      cbn [andb]; try (repeat split; auto; cbn; contradiction).
    unfold hears_move; rewrite S; cbn. repeat split; auto. intros e [[= <- -> ]|[]]; eauto.
  - destruct (_ && _) eqn:G; [|repeat split; auto; cbn; contradiction]. rewrite S.
    destruct (Nat.eqb_spec (mid c) r) as [M|]; [|repeat split; auto; cbn; contradiction].
    cbn [epochs repeating negb] in G; rewrite orb_false_r, andb_true_iff, !Nat.eqb_eq in G; exfalso; apply Q; now
      destruct G.
  - destruct (_ && _) eqn:G; [|repeat split; auto; cbn; contradiction]. rewrite S.
    destruct (Nat.eqb_spec (mid c) r) as [M|]; [|repeat split; auto; cbn; contradiction].
    cbn [epochs repeating negb] in G; rewrite orb_false_r, andb_true_iff, !Nat.eqb_eq in G; exfalso; apply Q; now
      destruct G.
  - rewrite S; destruct k; cbn; auto.
Qed.

Lemma offers_long : forall n me room c later x k, stage x = Offered c k ->
  Forall (leaves_offer me (call x) (mid c)) later -> expiries later <= k ->
  stage (after (wfr_step (repeating n) me room) x later) = Offered c (k - expiries later)
  /\ call (after (wfr_step (repeating n) me room) x later) = call x.
Proof.
  intros n me room c later; induction later as [|i later IH]; intros x k S F L; [cbn; now rewrite Nat.sub_0_r|].
  apply Forall_cons_iff in F; destruct F as [Q F]. pose proof (offers_on n me room x c k i S Q) as O; cbn zeta in O.
  unfold after in *; cbn [fold_left].
  destruct i as [|v f r m| |]; [| |cbn in L; destruct k as [|k]; [lia|]|contradiction];
    destruct O as [S' [C _]]; rewrite <- C in *; cbn [expiries filter length] in L |- *;
    (edestruct IH as [A B]; [exact S' | exact F | unfold expiries in *; cbn [filter length] in *; lia|]); split;
      assumption.
Qed.

(** A MOVE for a call is the first, with all repeats left, or what comes of a timer, with one less. Of the timers that
    go
    off while nobody answers, and no newer call of the WFR is heard, each of the first [n] repeats the MOVE; the next
    one does not, but is the end: the SBit is set. Nothing else makes the robot send a MOVE for the WFR. *)
Theorem moves_are_repeated : forall n me room ins i y m h,
  robot_step (repeating n) me room (robot_after (repeating n) me room ins) i = (y, Some m) -> says m = Move h ->
  exists k, doing y = Asking (to_wfr m) (of_call m) k
  /\ (k = n \/ (i = Waited /\ doing (robot_after (repeating n) me room ins) = Asking (to_wfr m) (of_call m) (S k)))
  /\ forall later j z out, Forall (leaves_asking me (to_wfr m) (of_call m)) (later ++ [j]) -> waits later <= k ->
      robot_step (repeating n) me room (after (robot_step (repeating n) me room) y later) j = (z, out) ->
      if (match j with Waited => true | _ => false end) then
        if waits later <? k then exists q, out = Some (bids q) /\ about q = to_wfr m /\ epoch q = of_call m
        else ~ moves_for (to_wfr m) out
             /\ exists q, record_of z (to_wfr m) = Some q /\ epoch q = of_call m /\ served q = true
      else ~ moves_for (to_wfr m) out.
Proof.
  intros n me room ins i y m h H M. pose proof (inv_always (repeating n) me room ins) as V.
  set (x := robot_after (repeating n) me room ins) in *; clearbody x.
  pose proof (inv_step (repeating n) me room x i V) as Vy; rewrite H in Vy; cbn [fst] in Vy.
  assert (exists k, doing y = Asking (to_wfr m) (of_call m) k
    /\ (k = n \/ (i = Waited /\ doing x = Asking (to_wfr m) (of_call m) (S k)))) as [k [D K]].
  { assert (forall z, asks (repeating n) z = (y, Some m) -> doing y = Asking (to_wfr m) (of_call m) n) as First.
    { intros z A; unfold asks in A; destruct (doing z); try discriminate.
      destruct (nearest _ _); [|discriminate]. now injection A as <- <-. }
    destruct i as [v f g s|v f to c| | |v f]; cbn [robot_step] in H.
    - exists n; split; [exact (First _ H) | now left].
    - destruct (to =? me); [|discriminate]. unfold heeds in H. destruct (record_of x v) as [q|]; [|discriminate].
      destruct (_ && _); [discriminate|]. destruct (match c with Some c => c =? me | None => false end).
      + cbn [consent repeating] in H; injection H as <- <-; cbn [says] in M. destruct (_ || _) in M; discriminate.
      + exists n; split; [exact (First _ H) | now left].
    - destruct (doing x) as [|w e [|k]|] eqn:X; try discriminate; cbn [repetition repeating] in H.
      + exists n; split; [exact (First _ H) | now left].
      + destruct (asks_open _ _ V _ _ _ X) as [q [R [_ E]]]. rewrite R in H; injection H as <- <-.
        destruct (record_in _ _ _ R) as [_ <-]. exists k; cbn; rewrite (E eq_refl); auto.
    - exists n; split; [destruct (doing x); exact (First _ H) | now left].
    - exists n; split; [|now left]. destruct (doing x); try discriminate. destruct (_ && _); [exact (First _ H) |
      discriminate]. }
  exists k; split; [exact D | split; [exact K|]]. intros later j z out F L J.
  apply Forall_app in F; destruct F as [F Q]; apply Forall_inv in Q.
  destruct (asks_long n me room _ _ later y k Vy D F L) as [Vl Dl].
  assert (j = Waited \/ j <> Waited) as [->|N] by (destruct j; (now left) || (right; discriminate)).
  - pose proof (asks_for n me room _ _ _ _ Vl Dl) as A; cbn zeta in A; rewrite J in A; cbn [fst snd] in A.
    destruct (Nat.ltb_spec (waits later) k) as [G|G].
    + destruct (k - waits later) as [|r] eqn:Rk; [lia|]. destruct A as [_ [q [R [E O]]]]; exists q.
      destruct (record_in _ _ _ R) as [_ B]; auto.
    + replace (k - waits later) with 0 in A by lia. exact A.
  - destruct (asks_on n me room _ _ _ _ j Vl Dl Q N) as [_ A]; rewrite J in A. destruct j; try exact A; contradiction.
Qed.

(** When a WFR has chosen it has all repeats left. Of the timers that go off while the robot chosen does not answer, and
    none comes, each of the first [n] repeats the RESB to it; the next one calls anew. Nothing else makes the WFR tell
    that robot of its choice but a MOVE of it. *)
Theorem resbs_are_repeated : forall n me room x i y out c k, wfr_step (repeating n) me room x i = (y, out) ->
  stage y = Offered c k -> (forall k, stage x <> Offered c k) -> k = n
  /\ forall later j z out, Forall (leaves_offer me (call y) (mid c)) (later ++ [j]) -> expiries later <= n ->
      wfr_step (repeating n) me room (after (wfr_step (repeating n) me room) y later) j = (z, out) ->
      match j with
      | Expires => out = if expiries later <? n then [Resb (call y) (mid c) (Some (mid c))] else [Calls (S (call y))]
      | _ => forall e, In (Resb e (mid c) (Some (mid c))) out -> exists h, j = Says me (call y) (mid c) (Move h)
      end.
Proof.
  intros n me room x i y out c k H S New.
  assert (k = n) as ->.
  { unfold wfr_step in H; destruct i as [|v f r m| |].
    - destruct (stage x) eqn:X; injection H as <- _; try discriminate; rewrite X in S; try discriminate; now destruct
      (New k).
    - destruct (_ && _); [|injection H as <- _; now apply New in S].
      destruct m; unfold hears_move in H; destruct (stage x) eqn:X; cbn [window choice_stands renewal repeating] in H;
        try (destruct (_ =? _)); cbn [andb] in H; injection H as <- _; cbn in S; try discriminate;
        try (rewrite X in S; try discriminate; injection S as -> ->; now destruct (New k)).
    - destruct (stage x) as [|[b|]|d [|g]|d|] eqn:X; cbn in H; injection H as <- _; cbn in S; try discriminate;
        try (rewrite X in S; discriminate).
      + now injection S as _ <-.
      + injection S as -> _; now destruct (New (Datatypes.S g)).
    - destruct (stage x) eqn:X; injection H as <- _; cbn in S; try discriminate; rewrite X in S; discriminate. }
  split; [reflexivity|]. intros later j z out' F L J. apply Forall_app in F; destruct F as [F Q]; apply Forall_inv in Q.
  destruct (offers_long n me room c later y n S F L) as [Sl Cl]. rewrite <- Cl in Q.
  pose proof (offers_on n me room _ c _ j Sl Q) as O; cbn zeta in O; rewrite J, Cl in O; cbn [fst snd] in O.
  destruct j as [|v f r m| |]; try apply O.
  destruct (Nat.ltb_spec (expiries later) n) as [G|G].
  - destruct (n - expiries later) as [|g] eqn:E; [lia|]. apply O.
  - replace (n - expiries later) with 0 in O by lia. exact O.
Qed.

(** Both. *)
Definition MRC_13 (n me room : nat) := conj (moves_are_repeated n me room) (resbs_are_repeated n me room).

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
