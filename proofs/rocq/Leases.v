(** MRC-1, MRC-2, MRC-4 and MRC-8, repaired, for any number of robots, WFRs, events and calls, whatever
    the network does.

    The clauses follow from ten sentences that every event keeps: [inv]. The two that carry the others: for one
    call a WFR never names two robots, and who has accepted the present call of a WFR that waits for it holds
    its lease. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Mrc.
Import ListNotations.

(** ** What a robot and a WFR can do, by themselves *)

(** What a robot does belongs to the call that it knows of. *)
Definition task_known (x : robot) : Prop :=
  forall w e, doing x = Asking w e \/ doing x = Leased w e -> exists q, record_of x w = Some q /\ epoch q = e.

(** Of its records each is as old as one that it had, or is of the call that it is just told of. *)
Definition records_from (x y : robot) (i : robot_input) : Prop :=
  forall q, In q (requests y) ->
    (exists p, In p (requests x) /\ wfr_of p = wfr_of q /\ epoch p = epoch q) \/ i = Told (Notice (wfr_of q) (epoch q)).

Lemma record_of_in : forall x w q, record_of x w = Some q -> In q (requests x) /\ wfr_of q = w.
Proof. intros x w q H; apply find_some in H; unfold about in H; now rewrite Nat.eqb_eq in H. Qed.

Lemma find_change : forall w f l v, (forall q, wfr_of q = w -> wfr_of (f q) = w) ->
  find (about v) (change w f l) = if v =? w then option_map f (find (about w) l) else find (about v) l.
Proof.
  intros w f l v F; unfold change, about; induction l as [|q l IH]; cbn [map find]; [now destruct (v =? w)|].
  destruct (Nat.eqb_spec (wfr_of q) w) as [E|E].
  - cbn [find]; rewrite (F q E); destruct (Nat.eqb_spec v w) as [->|D].
    + now rewrite Nat.eqb_refl.
    + rewrite IH. replace (wfr_of q =? v) with false by (symmetry; apply Nat.eqb_neq; congruence).
      now replace (w =? v) with false by (symmetry; apply Nat.eqb_neq; congruence).
  - rewrite IH; destruct (Nat.eqb_spec v w) as [->|D]; [|reflexivity].
    now replace (wfr_of q =? w) with false by (symmetry; apply Nat.eqb_neq; exact E).
Qed.

Lemma in_change : forall w f l q, In q (change w f l) -> exists p, In p l /\ (q = p \/ (wfr_of p = w /\ q = f p)).
Proof.
  intros w f l q H; unfold change in H; apply in_map_iff in H; destruct H as [p [E H]]; exists p; split; [exact H|].
  unfold about in E; destruct (Nat.eqb_spec (wfr_of p) w); auto.
Qed.

Lemma in_making_room : forall own q l l', In l' (making_room own q l) ->
  (forall p, In p l' -> p = q \/ In p l)
  /\ (forall w, own w = true -> wfr_of q <> w -> find (about w) l' = find (about w) l).
Proof.
  intros own q l; induction l as [|p l IH]; intros l' H; cbn in H; [contradiction|].
  apply in_app_or in H; destruct H as [H|H].
  - destruct (served p && negb (own (wfr_of p))) eqn:E; [|contradiction]. destruct H as [<-|[]].
    apply andb_true_iff in E; destruct E as [_ E]; apply negb_true_iff in E. split.
    + intros p' [<-|H]; cbn; auto.
    + intros w O D; cbn [find]; unfold about. destruct (Nat.eqb_spec (wfr_of q) w); [contradiction|].
      destruct (Nat.eqb_spec (wfr_of p) w); [congruence | reflexivity].
  - apply in_map_iff in H; destruct H as [k [<- H]]; destruct (IH k H) as [I1 I2]. split.
    + intros p' [<-|P]; cbn; auto. destruct (I1 p' P); auto.
    + intros w O D; cbn; destruct (about w p); auto.
Qed.

Lemma asks_requests : forall r z x out, In (x, out) (asks r z) -> requests x = requests z.
Proof.
  intros r z x out H; unfold asks in H; destruct H as [[= <- <-]|H]; [reflexivity|].
  destruct (doing z); try contradiction. apply in_flat_map in H; destruct H as [q [_ H]].
  destruct (record_of z (wfr_of q)) as [p|]; [|contradiction]. destruct (served p); [contradiction|].
  destruct H as [[= <- <-]|[]]; reflexivity.
Qed.

(** Whether it asks or not, its records stay, and what it asks for is the call that it knows of. *)
Lemma asks_facts : forall r z x out, In (x, out) (asks r z) -> task_known z ->
  task_known x
  /\ (forall m, In m out -> exists w e, m = Move w e r)
  /\ (doing x = doing z \/ (doing z = Free /\ exists w e, doing x = Asking w e)).
Proof.
  intros r z x out H K; unfold asks in H; destruct H as [[= <- <-]|H].
  { repeat split; auto; intros ? []. }
  destruct (doing z) eqn:D; try contradiction.
  apply in_flat_map in H; destruct H as [q [Q H]].
  destruct (record_of z (wfr_of q)) as [p|] eqn:R; [|contradiction]. destruct (served p); [contradiction|].
  destruct H as [[= <- <-]|[]]. cbn; split; [|split].
  - intros w e [[= <- <-]|E]; [|discriminate]. exists p; split; [|reflexivity].
    destruct (record_of_in _ _ _ R) as [_ W]. unfold record_of in *; cbn; now rewrite W.
  - intros m [<-|[]]; eauto.
  - right; split; eauto.
Qed.

Lemma serve_record : forall w x v,
  record_of (serve w x) v = option_map (fun q => if v =? w then {| wfr_of := wfr_of q; epoch := epoch q; served :=
    true |} else q)
                                       (record_of x v).
Proof.
  intros w x v; unfold record_of, serve; cbn [requests]. rewrite find_change by auto.
  destruct (Nat.eqb_spec v w) as [->|D]; [reflexivity|]. now destruct (find (about v) (requests x)).
Qed.

Lemma serve_known : forall w x t, task_known x -> (t = doing x \/ t = Free) -> task_known (now (serve w x) t).
Proof.
  intros w x t K T v e H; cbn in H. destruct T as [-> | ->]; [|destruct H; discriminate].
  destruct (K v e H) as [q [R E]]. change (record_of (now (serve w x) (doing x)) v) with (record_of (serve w x) v).
  rewrite serve_record, R; cbn; eexists; split; [reflexivity|]. now destruct (v =? w).
Qed.

Lemma now_known : forall x, task_known x -> task_known (now x Free).
Proof. intros x K w e [H|H]; discriminate. Qed.

Lemma serve_from : forall w x t i, records_from x (now (serve w x) t) i.
Proof.
  intros w x t i q H; cbn in H; apply in_change in H; destruct H as [p [P [->|[E ->]]]]; left; exists p; auto.
Qed.

(** Hearing a call. *)
Lemma notes_facts : forall x w e z, task_known x -> In z (notes REPAIRED x w e) ->
  task_known z /\ records_from x z (Told (Notice w e))
  /\ (doing z = doing x \/ (doing z = Free /\ forall f, doing x = Leased w f -> f < e)
      /\ forall v f, doing x = Leased v f -> v = w).
Proof.
  intros x w e z K H; unfold notes in H; destruct (record_of x w) as [q|] eqn:R; cbn [epochs REPAIRED] in H.
  - destruct (Nat.ltb_spec (epoch q) e) as [L|L]; [|destruct H as [<-|[]]; repeat split; auto; intros p P; eauto].
    destruct H as [<-|[]]. split; [|split].
    + intros v f T; cbn in T. assert (v <> w /\ (doing x = Asking v f \/ doing x = Leased v f)) as [D T'].
      { destruct (doing x) as [|u g|u g]; cbn in T; [destruct T; discriminate | |];
          destruct (Nat.eqb_spec u w); destruct T as [T|T]; try discriminate; injection T as -> ->; auto. }
      destruct (K v f T') as [p [P E]]; exists p; split; [|exact E].
      unfold record_of in *; cbn [requests]. rewrite find_change by auto.
      apply Nat.eqb_neq in D; now rewrite D.
    + intros p P; cbn in P; apply in_change in P; destruct P as [p' [P [->|[E ->]]]]; [left; eauto | right;
        reflexivity].
    + cbn. destruct (is_own (doing x) w) eqn:O; [right | left; reflexivity].
      split; [split; [reflexivity|]|].
      * intros f F; destruct (K w f (or_intror F)) as [p [P E]]. rewrite R in P; injection P as <-. lia.
      * intros v f F; rewrite F in O; cbn in O; now apply Nat.eqb_eq in O.
  - unfold adds in H; apply in_map_iff in H; destruct H as [l [<- H]]; cbn [requests doing].
    set (q := {| wfr_of := w; epoch := e; served := false |}) in *.
    assert ((forall p, In p l -> p = q \/ In p (requests x))
            /\ (forall v, is_own (doing x) v = true -> wfr_of q <> v ->
              find (about v) l = find (about v) (requests x))) as [A B].
    { destruct H as [<-|[<-|H]].
      - split; auto.
      - split; [intros p P; apply in_app_or in P; destruct P as [P|[<-|[]]]; auto|].
        intros v O D; induction (requests x) as [|p m IH]; cbn.
        + unfold about; cbn in *; destruct (Nat.eqb_spec w v); [contradiction | reflexivity].
        + now destruct (about v p).
      - now apply in_making_room in H. }
    split; [|split; [|left; reflexivity]].
    + intros v f T; cbn in T; destruct (K v f T) as [p [P E]]; exists p; split; [|exact E].
      unfold record_of; cbn [requests]. rewrite B; [exact P | |].
      * destruct T as [T|T]; rewrite T; cbn; apply Nat.eqb_refl.
      * cbn; intros <-; congruence.
    + intros p P; cbn in P; destruct (A p P) as [->|Q]; [right; reflexivity | left; eauto].
Qed.

(** What holds of a robot [x] that becomes [y] and sends [out]. *)
Record goes (r : nat) (x : robot) (i : robot_input) (y : robot) (out : list message) : Prop := {
  goes_known : task_known y;
  goes_records : records_from x y i;
  (** It accepts only what it is told just now, and only as it takes the lease or while it holds it. *)
  goes_says : forall m, In m out -> (exists w e, m = Move w e r) \/ (exists w e, m = Decline w e r)
    \/ exists w e, m = Accept w e r /\ i = Told (Resb w e r (Some r)) /\ doing y = Leased w e;
  (** It takes a lease only when it is told so while it asks for the call. *)
  goes_takes : forall w e, doing y = Leased w e -> doing x = Leased w e
    \/ (i = Told (Resb w e r (Some r)) /\ doing x = Asking w e);
  (** It lets a lease go only when it comes, when the lease lapses, and when it hears of a newer call. *)
  goes_keeps : forall w e, doing x = Leased w e -> doing y = Leased w e \/ i = Arrives \/ i = Lapses w e
    \/ exists f, i = Told (Notice w f) /\ e < f;
}.

Lemma records_same : forall x i, records_from x x i.
Proof. intros x i q H; left; eauto. Qed.

Lemma records_now : forall x t i, records_from x (now x t) i.
Proof. intros x t i q H; left; eauto. Qed.

Lemma nothing_goes : forall r x i y out, task_known x -> In (y, out) [(x, [])] -> goes r x i y out.
Proof.
  intros r x i y out K [[= <- <-]|[]]; constructor; auto; [apply records_same | intros m []].
Qed.

(** It may ask, after it has become [z]. *)
Lemma asks_goes : forall r x i z y out, In (y, out) (asks r z) -> task_known z -> records_from x z i ->
  (forall w e, doing z = Leased w e -> doing x = Leased w e) ->
  (forall w e, doing x = Leased w e -> doing z = Leased w e \/ i = Arrives \/ i = Lapses w e
      \/ exists f, i = Told (Notice w f) /\ e < f) ->
  goes r x i y out.
Proof.
  intros r x i z y out H K F L M; destruct (asks_facts r z y out H K) as [K' [O D]].
  constructor; auto.
  - intros q Q; rewrite (asks_requests r z y out H) in Q; now apply F.
  - intros w e X; destruct D as [D|[D [w' [e' D']]]]; [left; apply L; congruence | congruence].
  - intros w e X; destruct (M w e X) as [Y|Y]; [|auto]. destruct D as [D|[D _]]; [left; congruence | congruence].
Qed.

(** All that a robot can do, repaired. *)
Lemma robot_goes : forall r x i y out, task_known x -> In (y, out) (robot_outcomes REPAIRED r x i) -> goes r x i y out.
Proof.
  intros r x i y out K H; unfold robot_outcomes in H.
  destruct i as [[w e|w e a|w e a chosen|w e a|w e a]| | |w e];
    try (apply nothing_goes; assumption).
  - apply in_flat_map in H; destruct H as [z [Z H]].
    destruct (notes_facts x w e z K Z) as [K' [F D]].
    apply (asks_goes r x _ z y out H K' F).
    + intros v f L; destruct D as [D|[[D _] _]]; congruence.
    + intros v f L; destruct D as [D|[[D M] O]]; [left; congruence|].
      pose proof (O v f L) as ->. right; right; right; exists e; split; [reflexivity | now apply M].
  - destruct (Nat.eqb_spec a r) as [->|]; [|apply nothing_goes; assumption]. unfold heeds in H.
    destruct (record_of x w) as [q|] eqn:R; [|apply nothing_goes; assumption].
    cbn [epochs consent REPAIRED andb negb] in H.
    destruct (Nat.eqb_spec (epoch q) e) as [E|E]; [|apply nothing_goes; assumption]. cbn [negb] in H.
    assert (forall v f, doing x = Asking v f \/ doing x = Leased v f -> v = w -> f = e) as Known.
    { intros v f T ->; destruct (K w f T) as [p [P Q]]; rewrite R in P; injection P as <-; congruence. }
    assert (task_known (serve w x)) as KS by (apply (serve_known w x (doing x)); auto).
    assert (forall t i, records_from x (now (serve w x) t) i) as FS by (intros; apply serve_from).
    destruct (match chosen with Some c => c =? r | None => false end) eqn:C.
    + assert (chosen = Some r) as -> by (destruct chosen as [c|]; [apply Nat.eqb_eq in C; now subst | discriminate]).
      rewrite orb_false_r in H. destruct H as [[= <- <-]|[]].
      destruct (doing x) as [|v f|v f] eqn:D; cbn [orb]; try destruct (Nat.eqb_spec v w) as [->|N]; cbn [orb].
      * constructor; [exact KS | apply (FS (doing x)) | | |]; cbn; rewrite ?D; try (intros; discriminate).
        intros m [<-|[]]; right; left; eauto.
      * assert (f = e) as -> by (apply (Known w f); auto).
        constructor; [| apply FS | | |]; cbn; rewrite ?D; try (intros; discriminate).
        -- intros u g [T|T]; [discriminate|]; injection T as <- <-.
           change (record_of (now (serve w x) (Leased w e)) w) with (record_of (serve w x) w); rewrite serve_record,
             R; cbn.
           eexists; split; [reflexivity|]; now rewrite Nat.eqb_refl.
        -- intros m [<-|[]]; right; right; exists w, e; auto.
        -- intros u g [= <- <-]; auto.
      * constructor; [exact KS | apply (FS (doing x)) | | |]; cbn; rewrite ?D; try (intros; discriminate).
        intros m [<-|[]]; right; left; eauto.
      * assert (f = e) as -> by (apply (Known w f); auto).
        constructor; [exact KS | apply (FS (doing x)) | | |]; cbn; rewrite ?D; auto.
        intros m [<-|[]]; right; right; exists w, e; auto.
      * constructor; [exact KS | apply (FS (doing x)) | | |]; cbn; rewrite ?D; auto.
        intros m [<-|[]]; right; left; eauto.
    + rewrite andb_false_r, orb_false_r in H.
      destruct (doing x) as [|v f|v f] eqn:D; [|destruct (v =? w)|];
        (eapply asks_goes; [exact H | first [exact KS | apply now_known; exact KS] |
          first [apply (FS Free) | apply (FS (doing x))] | |]); cbn; rewrite ?D; intros; try discriminate; auto.
  - destruct (doing x) as [|w e|w e] eqn:D; try (apply nothing_goes; assumption). destruct H as [[= <- <-]|H].
    + constructor; auto; [apply records_same | intros m [<-|[]]; left; eauto].
    + eapply asks_goes; [exact H | apply serve_known; auto | apply serve_from | |]; cbn; intros; congruence.
  - destruct (doing x) as [|w e|w e] eqn:D;
      (eapply asks_goes; [exact H | first [exact K | apply now_known;
        exact K] | first [apply records_now | apply records_same] | |]);
      cbn; intros; auto; congruence.
  - destruct (doing x) as [|v f|v f] eqn:D; try (apply nothing_goes; assumption).
    destruct (Nat.eqb_spec v w) as [->|], (Nat.eqb_spec f e) as [->|]; cbn [andb] in H; try (apply nothing_goes;
      assumption).
    eapply asks_goes; [exact H | apply now_known; exact K | first [apply records_now | apply records_same] | |]; cbn;
      intros u g T; [discriminate|].
    rewrite D in T; injection T as <- <-; auto.
Qed.

(** All that a WFR can do, repaired. *)
Inductive changes (w : nat) (x : wfr) (i : wfr_input) (y : wfr) (out : list message) : Prop :=
| stays_so : call y = call x ->
    (stage y = stage x \/ exists b b', stage x = Collecting b /\ stage y = Collecting b') ->
    (forall m, In m out -> exists r c, m = Resb w (call x) r c
      /\ forall q, c = Some q -> stage x = Offered q \/ stage x = CountsOn q) ->
    changes w x i y out
| chooses : forall b, call y = call x -> stage x = Collecting (Some b) -> stage y = Offered b ->
    (forall m, In m out -> exists r, m = Resb w (call x) r (Some b)) -> changes w x i y out
| calls : (call y = call x /\ stage x = Idle \/ call y = S (call x)) -> stage y = Collecting None ->
    out = [Notice w (call y)] -> changes w x i y out
| is_accepted : forall c, i = Hears (Accept w (call x) c) -> stage x = Offered c ->
    call y = call x -> stage y = CountsOn c -> out = [] -> changes w x i y out
| is_reached : i = Reached -> call y = call x -> stage y = Rescued -> out = [] -> changes w x i y out.

Lemma same_changes : forall w x i y out, In (y, out) [(x, [])] -> changes w x i y out.
Proof. intros w x i y out [[= <- <-]|[]]; apply stays_so; auto; intros m []. Qed.

Lemma wfr_changes : forall w x i y out, In (y, out) (wfr_outcomes REPAIRED w x i) -> changes w x i y out.
Proof.
  intros w x i y out H; unfold wfr_outcomes in H; cbn [epochs REPAIRED negb orb] in H.
  destruct i as [|[v e|v e r|v e r c|v e r|v e r]| |]; try (apply same_changes; assumption).
  - destruct (stage x) eqn:P; try (apply same_changes; assumption); destruct H as [[= <- <-]|[]]; apply calls; cbn;
      auto.
  - destruct ((v =? w) && (e =? call x)) eqn:M; [|apply same_changes; assumption].
    unfold hears_move in H; cbn [choice_stands REPAIRED] in H.
    destruct (stage x) as [|best|c|c|] eqn:P; try (apply same_changes; assumption).
    + apply in_flat_map in H; destruct H as [a [_ H]]; apply in_map_iff in H; destruct H as [b [[= <- <-] _]].
      apply stays_so; cbn; auto; [right; eauto | intros m []].
    + destruct H as [[= <- <-]|[[= <- <-]|[]]]; apply stays_so; auto; intros m []; [|contradiction].
      subst m; exists r, (Some c); split; [reflexivity|]. intros q [= <-]; auto.
    + destruct H as [[= <- <-]|[[= <- <-]|[]]]; apply stays_so; auto; intros m []; [|contradiction].
      subst m; exists r, (Some c); split; [reflexivity|]. intros q [= <-]; auto.
    + destruct H as [[= <- <-]|[[= <- <-]|[]]]; apply stays_so; auto; intros m []; [|contradiction].
      subst m; exists r, None; split; [reflexivity|]. intros q [=].
  - destruct (stage x) as [|best|c|c|] eqn:P; try (apply same_changes; assumption).
    destruct (Nat.eqb_spec v w) as [->|], (Nat.eqb_spec e (call x)) as [->|], (Nat.eqb_spec c r) as [->|];
      cbn [andb] in H; try (apply same_changes; assumption).
    destruct H as [[= <- <-]|[]]. apply is_accepted with (c := r); auto.
  - destruct (stage x) as [|best|c|c|] eqn:P; try (apply same_changes; assumption).
    destruct ((v =? w) && (e =? call x) && (c =? r)); [|apply same_changes; assumption].
    destruct H as [[= <- <-]|[]]; apply calls; cbn; auto.
  - destruct (stage x) as [|[b|]|c|c|] eqn:P; try (apply same_changes; assumption).
    + destruct H as [[= <- <-]|[]]; apply chooses with (b := b); cbn; auto.
      intros m M; apply in_map_iff in M; destruct M as [r [<- _]]; eauto.
    + destruct H as [[= <- <-]|[]]; apply calls; cbn; auto.
    + destruct H as [[= <- <-]|[[= <- <-]|[]]]; [|apply calls; cbn; auto].
      apply stays_so; auto; intros m [<-|[]]. exists c, (Some c); split; [reflexivity|]. intros q [= <-]; auto.
    + destruct H as [[= <- <-]|[]]; apply calls; cbn; auto.
  - destruct (stage x) as [|best|c|c|] eqn:P; try (apply same_changes; assumption);
      destruct H as [[= <- <-]|[]]; apply is_reached; auto.
Qed.

(** ** What every event keeps *)

Record inv (s : rescue) : Prop := {
  (** Messages and records are of calls that were made. *)
  notices_called : forall w e, In (Notice w e) (sent s) -> e <= call (wfrs s w);
  choices_called : forall w e r c, In (Resb w e r c) (sent s) -> e <= call (wfrs s w);
  records_called : forall r q, In q (requests (robots s r)) -> epoch q <= call (wfrs s (wfr_of q));
  (** Who has been named for the present call is the choice, until a robot has come. *)
  choice_is_stage : forall w r c, In (Resb w (call (wfrs s w)) r (Some c)) (sent s) ->
    stage (wfrs s w) = Offered c \/ stage (wfrs s w) = CountsOn c \/ stage (wfrs s w) = Rescued;
  (** One name for a call. *)
  one_choice : forall w e r r' c c', In (Resb w e r (Some c)) (sent s) -> In (Resb w e r' (Some c')) (sent s) -> c = c';
  tasks_known : forall r, task_known (robots s r);
  (** Who holds a lease, or has accepted it, was chosen. *)
  leased_chosen : forall r w e, doing (robots s r) = Leased w e -> In (Resb w e r (Some r)) (sent s);
  accepted_chosen : forall w e r, In (Accept w e r) (sent s) -> In (Resb w e r (Some r)) (sent s);
  (** Who has accepted the present call of a WFR that waits for it holds the lease. *)
  accepted_holds : forall w r, In (Accept w (call (wfrs s w)) r) (sent s) -> waits (wfrs s w) ->
    doing (robots s r) = Leased w (call (wfrs s w));
  (** Who is counted on has accepted. *)
  counted_accepted : forall w c, stage (wfrs s w) = CountsOn c -> In (Accept w (call (wfrs s w)) c) (sent s);
}.

Lemma put_same : forall (A : Type) (f : nat -> A) n x, put f n x n = x.
Proof. intros; unfold put; now rewrite Nat.eqb_refl. Qed.
Lemma put_other : forall (A : Type) (f : nat -> A) n x m, m <> n -> put f n x m = f m.
Proof. intros A f n x m D; unfold put; apply Nat.eqb_neq in D; now rewrite D. Qed.

Lemma inv_start : inv nothing_yet.
Proof.
  constructor; cbn; try contradiction; try discriminate.
  intros r w e [H|H]; discriminate.
Qed.

(** An event at a WFR. What it has sent is in front. *)
Lemma inv_wfr : forall s w i y out, inv s -> (i = Reached \/ wfr_may s i) ->
  In (y, out) (wfr_outcomes REPAIRED w (wfrs s w) i) ->
  inv {| robots := robots s; wfrs := put (wfrs s) w y; sent := out ++ sent s |}.
Proof.
  intros s w i y out V M H; apply wfr_changes in H.
  (* the number of the call never falls *)
  assert (call (wfrs s w) <= call y) as Grow by (destruct H as [-> _ _|b -> _ _ _|[[-> _]| ->] _ _|c _ _ -> _ _|_ ->
    _ _]; lia).
  assert (forall v, call (wfrs s v) <= call (put (wfrs s) w y v)) as GrowAll.
  { intros v; destruct (Nat.eq_dec v w) as [->|D]; [now rewrite put_same | now rewrite put_other]. }
  (* what it sends *)
  assert (forall m, In m out -> (m = Notice w (call y)) \/ exists r c, m = Resb w (call y) r c
            /\ call y = call (wfrs s w) /\ forall q, c = Some q ->
               (stage (wfrs s w) = Offered q \/ stage (wfrs s w) = CountsOn q
                \/ (stage (wfrs s w) = Collecting (Some q) /\ stage y = Offered q))) as Out.
  { intros m I; destruct H as [E _ O|b E P Q O|_ _ ->|c _ _ _ _ ->|_ _ _ ->]; try contradiction.
    - destruct (O m I) as [r [c [-> C]]]; right; exists r, c; rewrite E; repeat split; auto.
      intros q F; destruct (C q F); auto.
    - destruct (O m I) as [r ->]; right; exists r, (Some b); rewrite E; repeat split; auto. intros q [= <-]; auto.
    - destruct I as [<-|[]]; auto. }
  assert (forall m, In m (out ++ sent s) -> In m out \/ In m (sent s)) as App by (intros m; apply in_app_or).
  assert (forall m, In m (sent s) -> In m (out ++ sent s)) as Old by (intros; apply in_or_app; auto).
  (* nobody was named yet for a call whose choice is still open *)
  assert (forall r q, (forall c, stage (wfrs s w) <> Offered c) -> (forall c, stage (wfrs s w) <> CountsOn c) ->
            stage (wfrs s w) <> Rescued -> ~ In (Resb w (call (wfrs s w)) r (Some q)) (sent s)) as Unnamed.
  { intros r q A B C I; destruct (choice_is_stage s V w r q I) as [X|[X|X]]; [eapply A | eapply B | apply C]; exact X. }
  constructor; cbn [robots wfrs sent].
  - intros v e I; apply App in I; destruct I as [I|I].
    + destruct (Out _ I) as [[= -> ->]|[r [c [E _]]]]; [now rewrite put_same | discriminate].
    + eapply Nat.le_trans; [eapply notices_called; eauto | apply GrowAll].
  - intros v e r c I; apply App in I; destruct I as [I|I].
    + destruct (Out _ I) as [E|[r' [c' [[= -> -> -> ->] _]]]]; [discriminate | now rewrite put_same].
    + eapply Nat.le_trans; [eapply choices_called; eauto | apply GrowAll].
  - intros r q I; eapply Nat.le_trans; [eapply records_called; eauto | apply GrowAll].
  - intros v r c I; destruct (Nat.eq_dec v w) as [->|D].
    + rewrite put_same in *; apply App in I; destruct I as [I|I].
      * destruct (Out _ I) as [E|[r' [c' [E [_ C]]]]]; [discriminate|]. injection E as _ <-.
        destruct H as [_ [Q|[b [b' [P Q]]]] _|b _ P Q _|_ _ ->|c' _ _ _ _ ->|_ _ _ ->];
          try (destruct I as [I|[]]; discriminate); try contradiction;
          destruct (C c eq_refl) as [X|[X|[_ X]]]; try congruence; try (left; congruence); right; left; congruence.
      * destruct H as [E [Q|[b [b' [P Q]]]] _|b E P Q _|[[E P]|E] Q _|c' _ P E Q _|_ E Q _]; rewrite ?E, ?Q in *; auto.
        -- now apply (choice_is_stage s V w r c).
        -- exfalso; apply (Unnamed r c); congruence.
        -- exfalso; apply (Unnamed r c); congruence.
        -- exfalso; apply (Unnamed r c); congruence.
        -- apply (choices_called s V) in I; lia.
        -- destruct (choice_is_stage s V w r c I) as [X|[X|X]]; try congruence. right; left; congruence.
    + rewrite put_other in * by exact D; apply App in I; destruct I as [I|I].
      * destruct (Out _ I) as [E|[r' [c' [E _]]]]; congruence.
      * now apply (choice_is_stage s V v r c).
  - assert (forall v e r r' c c', In (Resb v e r (Some c)) out -> In (Resb v e r' (Some c')) (out ++ sent s) ->
      c = c') as One.
    { intros v e r r' c c' I J; destruct (Out _ I) as [E|[r1 [c1 [E [F C]]]]]; [discriminate|]. injection E as -> ->
        -> <-.
      assert (stage (wfrs s w) = Offered c \/ stage (wfrs s w) = CountsOn c \/ stage (wfrs s w) = Collecting (Some c))
        as X
        by (destruct (C c eq_refl) as [X|[X|[X _]]]; auto).
      apply App in J; destruct J as [J|J].
      - destruct (Out _ J) as [E|[r2 [c2 [E [F' C']]]]]; [discriminate|]. injection E as -> <-.
        destruct (C' c' eq_refl) as [Y|[Y|[Y _]]], X as [X|[X|X]]; congruence.
      - rewrite F in J; destruct (choice_is_stage s V w r' c' J) as [Y|[Y|Y]], X as [X|[X|X]]; congruence. }
    intros v e r r' c c' I J; apply App in I; destruct I as [I|I]; [eapply One; eauto|].
    apply App in J; destruct J as [J|J]; [symmetry; eapply One; eauto | eapply one_choice; eauto].
  - apply (tasks_known s V).
  - intros r v e L; apply Old; now apply (leased_chosen s V).
  - intros v e r I; apply App in I; destruct I as [I|I].
    + destruct (Out _ I) as [E|[r' [c' [E _]]]]; discriminate.
    + apply Old; now apply (accepted_chosen s V).
  - intros v r I W; apply App in I; destruct I as [I|I].
    { destruct (Out _ I) as [E|[r' [c' [E _]]]]; discriminate. }
    destruct (Nat.eq_dec v w) as [->|D]; [|rewrite put_other in * by exact D; now apply (accepted_holds s V)].
    rewrite put_same in *; unfold waits in W.
    destruct H as [E [Q|[b [b' [P Q]]]] _|b E P Q _|[[E P]|E] Q _|c' _ P E Q _|_ E Q _]; rewrite ?E, ?Q in *;
      try contradiction.
    + apply (accepted_holds s V); [exact I | exact W].
    + exfalso; apply (accepted_chosen s V) in I; revert I; apply Unnamed; congruence.
    + apply (accepted_holds s V); [exact I | unfold waits; now rewrite P].
  - intros v c P'; destruct (Nat.eq_dec v w) as [->|D].
    + rewrite put_same in *.
      destruct H as [E [Q|[b [b' [P Q]]]] _|b E P Q _|_ Q _|c' J P E Q _|_ E Q _]; try congruence.
      * rewrite E; apply Old, (counted_accepted s V); congruence.
      * rewrite E; apply Old. destruct M as [M|M]; [congruence|]. rewrite J in M; cbn in M. congruence.
    + rewrite put_other in * by exact D; apply Old; now apply (counted_accepted s V).
Qed.

(** What may happen to a robot. It comes to a WFR that no longer waits for it, or has never. *)
Definition may (s : rescue) (r : nat) (i : robot_input) : Prop :=
  match i with
  | Arrives => forall w e, doing (robots s r) = Leased w e -> ~ waits (wfrs s w)
  | Told _ | Waited | Lapses _ _ => robot_may s i
  end.

Lemma inv_robot : forall s r i y out, inv s -> may s r i -> In (y, out) (robot_outcomes REPAIRED r (robots s r) i) ->
  inv {| robots := put (robots s) r y; wfrs := wfrs s; sent := out ++ sent s |}.
Proof.
  intros s r i y out V M H; apply robot_goes in H; [|apply (tasks_known s V)]; destruct H as [K F O T L].
  assert (forall m, In m (out ++ sent s) -> In m out \/ In m (sent s)) as App by (intros m; apply in_app_or).
  assert (forall m, In m (sent s) -> In m (out ++ sent s)) as Old by (intros; apply in_or_app; auto).
  assert (forall w e c, In (Notice w e) out \/ (exists to, In (Resb w e to c) out) -> False) as NoCall.
  { intros w e c [I|[to I]]; destruct (O _ I) as [[v [f E]]|[[v [f E]]|[v [f [E _]]]]]; discriminate. }
  constructor; cbn [robots wfrs sent].
  - intros w e I; apply App in I; destruct I as [I|I]; [exfalso; eapply (NoCall w e None);
      eauto | now apply (notices_called s V)].
  - intros w e a c I; apply App in I; destruct I as [I|I]; [exfalso; eapply NoCall;
      eauto | eapply (choices_called s V); eauto].
  - intros a q I; destruct (Nat.eq_dec a r) as [->|D].
    + rewrite put_same in I; destruct (F q I) as [[p [P [W E]]]|J].
      * rewrite <- W, <- E; now apply (records_called s V r).
      * rewrite J in M; cbn in M; now apply (notices_called s V).
    + rewrite put_other in I by exact D; now apply (records_called s V a).
  - intros w a c I; apply App in I; destruct I as [I|I]; [exfalso; eapply NoCall;
      eauto | eapply (choice_is_stage s V); eauto].
  - intros w e a a' c c' I J; apply App in I, J.
    destruct I as [I|I]; [exfalso; eapply NoCall; eauto|]. destruct J as [J|J]; [exfalso; eapply NoCall; eauto|].
    eapply (one_choice s V); eauto.
  - intros a; destruct (Nat.eq_dec a r) as [->|D]; [now rewrite put_same | rewrite put_other by exact D;
      apply (tasks_known s V)].
  - intros a w e X; apply Old; destruct (Nat.eq_dec a r) as [->|D].
    + rewrite put_same in X; destruct (T w e X) as [Y|[J _]]; [now apply (leased_chosen s V)|].
      rewrite J in M; exact M.
    + rewrite put_other in X by exact D; now apply (leased_chosen s V).
  - intros w e a I; apply App in I; apply Old; destruct I as [I|I]; [|now apply (accepted_chosen s V)].
    destruct (O _ I) as [[v [f E]]|[[v [f E]]|[v [f [[= -> -> ->] [J _]]]]]]; try discriminate. rewrite J in M; exact M.
  - intros w a I W; apply App in I; destruct I as [I|I].
    { destruct (O _ I) as [[v [f E]]|[[v [f E]]|[v [f [[= -> <- ->] [_ D]]]]]];
        try discriminate. now rewrite put_same. }
    pose proof (accepted_holds s V w a I W) as X.
    destruct (Nat.eq_dec a r) as [->|D]; [rewrite put_same | now rewrite put_other].
    destruct (L w _ X) as [Y|[J|[J|[f [J G]]]]]; [exact Y | exfalso | exfalso | exfalso]; rewrite J in M; cbn in M.
    + now apply (M w _ X).
    + apply M; auto.
    + apply (notices_called s V) in M; lia.
  - intros w c P; apply Old; now apply (counted_accepted s V).
Qed.

Lemma inv_always : forall s, reached REPAIRED s -> inv s.
Proof.
  intros s R; induction R as [|s s' R V E];
    [apply inv_start|]. destruct E as [w i x out M H|r i x out M H|r w e x out y none D H G].
  - eapply inv_wfr; eauto.
  - apply inv_robot with (i := i); auto. destruct i; cbn in M |- *; try exact M; contradiction.
  - pose proof (inv_wfr s w Reached y none V (or_introl eq_refl) G) as V'.
    apply (inv_robot _ r Arrives x out V'); [|exact H].
    cbn [may robots wfrs]; intros v f L; rewrite D in L; injection L as <- <-; rewrite put_same.
    cbn in G; unfold waits; destruct (stage (wfrs s w)) eqn:P; destruct G as [[= <- _]|[]]; cbn; rewrite ?P; auto.
Qed.

(** ** The clauses *)

(** Two robots are never on their way for the same call of a WFR. *)
Theorem MRC_1 : forall s, reached REPAIRED s -> forall w e r r',
  doing (robots s r) = Leased w e -> doing (robots s r') = Leased w e -> r = r'.
Proof.
  intros s R w e r r' A B; pose proof (inv_always s R) as V.
  eapply (one_choice s V); eapply (leased_chosen s V); eauto.
Qed.

(** A WFR counts on a robot only if the robot has taken the lease of its call: it holds it now. *)
Theorem MRC_4 : forall s, reached REPAIRED s -> forall w c,
  stage (wfrs s w) = CountsOn c -> doing (robots s c) = Leased w (call (wfrs s w)).
Proof.
  intros s R w c P; pose proof (inv_always s R) as V.
  apply (accepted_holds s V); [now apply (counted_accepted s V) | unfold waits; now rewrite P].
Qed.

(** Two WFRs never count on the same robot. *)
Theorem MRC_2 : forall s, reached REPAIRED s -> forall w w' c,
  stage (wfrs s w) = CountsOn c -> stage (wfrs s w') = CountsOn c -> w = w'.
Proof.
  intros s R w w' c P Q; pose proof (MRC_4 s R w c P) as A; pose proof (MRC_4 s R w' c Q) as B. congruence.
Qed.

(** A robot takes the lease of a call only when it is told, while it asks for that call, that it is chosen. *)
Theorem MRC_8 : forall s, reached REPAIRED s -> forall r i x out, In (x,
  out) (robot_outcomes REPAIRED r (robots s r) i) ->
  forall w e, doing x = Leased w e -> doing (robots s r) <> Leased w e ->
  i = Told (Resb w e r (Some r)) /\ doing (robots s r) = Asking w e.
Proof.
  intros s R r i x out H w e L N; pose proof (inv_always s R) as V.
  apply robot_goes in H; [|apply (tasks_known s V)]. destruct (goes_takes _ _ _ _ _ H w e L);
    [contradiction | assumption].
Qed.
