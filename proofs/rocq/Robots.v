(** What every input of a robot keeps: one record of a WFR, and what it is free to ask for. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines.
Import ListNotations.

Definition robot_after (rl : rule) (me room : nat) : list robot_input -> robot :=
  after (robot_step rl me room) fresh_robot.

(** ** Records by themselves *)

Lemma after_snoc : forall (S I O : Type) (step : S -> I -> S * O) x l i,
  after step x (l ++ [i]) = fst (step (after step x l) i).
Proof. intros; unfold after; now rewrite fold_left_app. Qed.

Lemma record_in : forall x w q, record_of x w = Some q -> In q (requests x) /\ about q = w.
Proof. intros x w q H; apply find_some in H; unfold is_about in H; now rewrite Nat.eqb_eq in H. Qed.

Lemma no_record : forall x w, record_of x w = None -> ~ In w (map about (requests x)).
Proof.
  intros x w H I; apply in_map_iff in I; destruct I as [q [E I]]. apply (find_none _ _ H) in I.
  unfold is_about in I; apply Nat.eqb_neq in I; contradiction.
Qed.

Lemma one_record : forall l q, NoDup (map about l) -> In q l -> find (is_about (about q)) l = Some q.
Proof.
  intros l q; induction l as [|p l IH]; cbn; intros N I; [contradiction|].
  apply NoDup_cons_iff in N; destruct N as [A N]; unfold is_about at 1.
  destruct I as [->|I]; [now rewrite Nat.eqb_refl|].
  destruct (Nat.eqb_spec (about p) (about q)) as [E|E]; [|now apply IH].
  exfalso; apply A; rewrite E; now apply in_map.
Qed.

Lemma find_change : forall w f l v, (forall q, about q = w -> about (f q) = w) ->
  find (is_about v) (change w f l) = if v =? w then option_map f (find (is_about v) l) else find (is_about v) l.
Proof.
  intros w f l v F; unfold change, is_about; induction l as [|q l IH]; cbn [map find]; [now destruct (v =? w)|].
  destruct (Nat.eqb_spec (about q) w) as [E|E].
  - cbn [find]; rewrite (F q E); destruct (Nat.eqb_spec v w) as [->|D].
    + now rewrite Nat.eqb_refl, <- E, Nat.eqb_refl.
    + rewrite IH. replace (about q =? v) with false by (symmetry; apply Nat.eqb_neq; congruence).
      now replace (w =? v) with false by (symmetry; apply Nat.eqb_neq; congruence).
  - cbn [find]; destruct (Nat.eqb_spec (about q) v) as [<-|D]; [|exact IH].
    now replace (about q =? w) with false by (symmetry; now apply Nat.eqb_neq).
Qed.

Lemma about_change : forall w f l, (forall q, about q = w -> about (f q) = w) -> map about (change w f l) = map about l.
Proof.
  intros w f l F; unfold change; rewrite map_map; apply map_ext; intros q; unfold is_about.
  destruct (Nat.eqb_spec (about q) w) as [E|E]; [now rewrite F, E | reflexivity].
Qed.

Lemma about_noted : forall rl q heard, about q = about heard -> about (noted rl q heard) = about heard.
Proof. intros rl q heard E; unfold noted; destruct (_ && _); [reflexivity|]. destruct (_ && _); exact E. Qed.

Lemma gives_way_facts : forall own q l, ~ In (about q) (map about l) -> NoDup (map about l) ->
  NoDup (map about (gives_way own q l))
  /\ (forall v, In v (map about (gives_way own q l)) -> v = about q \/ In v (map about l))
  /\ (forall v, own v = true -> v <> about q -> find (is_about v) (gives_way own q l) = find (is_about v) l)
  /\ (forall p, In p (gives_way own q l) -> p = q \/ In p l).
Proof.
  intros own q l; induction l as [|p l IH]; intros A N; cbn [gives_way]; [repeat split; auto|].
  cbn [map In] in A; apply NoDup_cons_iff in N; destruct N as [P N].
  destruct (served p && negb (own (about p))) eqn:E.
  - repeat split.
    + cbn; constructor; tauto.
    + cbn; intuition.
    + intros v O D; cbn; unfold is_about. apply andb_true_iff in E; destruct E as [_ E]; apply negb_true_iff in E.
      destruct (Nat.eqb_spec (about q) v); [congruence|]. destruct (Nat.eqb_spec (about p) v);
        [congruence | reflexivity].
    + cbn; intuition.
  - destruct IH as [I1 [I2 [I3 I4]]]; [tauto | exact N|]. repeat split.
    + cbn; constructor; [|exact I1]. intros I; destruct (I2 _ I); tauto.
    + cbn; intros v [<-|I]; [auto|]. destruct (I2 _ I); auto.
    + intros v O D; cbn; now rewrite I3.
    + cbn; intros v [<-|I]; [auto|]. destruct (I4 _ I); auto.
Qed.

Lemma find_append : forall v q l, ~ In (about q) (map about l) ->
  find (is_about v) (l ++ [q]) = if about q =? v then Some q else find (is_about v) l.
Proof.
  intros v q l A; unfold is_about in *; induction l as [|p l IH]; cbn [app find]; [reflexivity|].
  cbn in A; destruct (Nat.eqb_spec (about p) v) as [E|E]; [|apply IH; tauto].
  now replace (about q =? v) with false by (symmetry; apply Nat.eqb_neq; intros <-; tauto).
Qed.

(** ** One step *)

Section Step.
  Variables (rl : rule) (me room : nat).

  Lemma asks_requests : forall x, requests (fst (asks rl x)) = requests x.
  Proof. intros x; unfold asks; destruct (doing x), (nearest rl (requests x)); reflexivity. Qed.

  (** The WFR whose SBit is set. *)
  Definition set_by (x : robot) (i : robot_input) : option nat :=
    match i with
    | Tells w e to _ =>
        match record_of x w with
        | Some q => if (to =? me) && negb (epochs rl && negb (epoch q =? e)) then Some w else None
        | None => None
        end
    | Waited => match doing x with Asking w _ 0 => if repetition rl then Some w else None | _ => None end
    | _ => None
    end.

  Lemma requests_after : forall x i, requests (fst (robot_step rl me room x i)) =
    match i with
    | Notice w e h s => requests (notes rl room x {| about := w; epoch := e; served := false; hops := S h;
      parent := s |})
    | _ => match set_by x i with Some w => serve w (requests x) | None => requests x end
    end.
  Proof.
    intros x [w e h s|w e to c| | |w e]; cbn [robot_step set_by].
    - now rewrite asks_requests.
    - destruct (to =? me); cbn [andb]; [|now destruct (record_of x w)]. unfold heeds. destruct (record_of x w) as [q|];
        [|reflexivity]. destruct (_ && _); cbn [negb]; [reflexivity|].
      destruct (match c with Some c => c =? me | None => false end); [reflexivity | now rewrite asks_requests].
    - destruct (doing x) as [|w e [|k]|]; try reflexivity; destruct (repetition rl); try reflexivity;
        now rewrite asks_requests.
    - destruct (doing x); now rewrite asks_requests.
    - destruct (doing x); try reflexivity. destruct (_ && _); [now rewrite asks_requests | reflexivity].
  Qed.

  Lemma serve_about : forall w l, map about (serve w l) = map about l.
  Proof. intros w l; unfold serve; now rewrite about_change by auto. Qed.

  Lemma serve_record : forall w v l, find (is_about v) (serve w l) =
    if v =? w then option_map set_bit (find (is_about v) l) else find (is_about v) l.
  Proof. intros w v l; unfold serve; now rewrite find_change by auto. Qed.

  Lemma notes_once : forall x heard, NoDup (map about (requests x)) -> NoDup (map about (requests (notes rl room x
    heard))).
  Proof.
    intros x heard N; unfold notes. destruct (record_of x (about heard)) as [q|] eqn:R; cbn [requests].
    - rewrite about_change; [exact N|]. intros p E; now apply about_noted.
    - apply no_record in R; unfold adds; destruct (_ <? _); [|now apply gives_way_facts].
      rewrite map_app; cbn. apply (NoDup_Add (a := about heard) (l := map about (requests x)));
        [rewrite <- (app_nil_r (map about (requests x))) at 1; apply Add_app | now split].
  Qed.

  Lemma once_step : forall x i, NoDup (map about (requests x)) -> NoDup (map about (requests (fst (robot_step rl me
    room x i)))).
  Proof.
    intros x i N; rewrite requests_after; destruct i; try apply notes_once; try exact N;
      (destruct (set_by x _); [now rewrite serve_about | exact N]).
  Qed.

  (** The nearest call is one whose SBit is clear. *)
  Lemma nearest_in : forall l q, nearest rl l = Some q -> In q l /\ served q = false.
  Proof.
    intros l q H; unfold nearest in H.
    assert (forall k best, fold_left (nearer rl) k best = Some q -> best = Some q \/ In q k) as G.
    { induction k as [|p k IH]; intros best F; cbn in F; [auto|]. destruct (IH _ F) as [E|I]; [|right; now right].
      unfold nearer in E; destruct best as [first|]; [destruct (is_nearer rl first p)|]; try injection E as ->; cbn;
        auto. }
    destruct (G _ _ H) as [[=]|I]. apply filter_In in I; destruct I as [I S]. now apply negb_true_iff in S.
  Qed.

  Lemma none_nearest : forall l, nearest rl l = None -> forall q, In q l -> served q = true.
  Proof.
    intros l H q I; unfold nearest in H.
    assert (forall k best, fold_left (nearer rl) k best = None -> best = None /\ k = []) as G.
    { induction k as [|p k IH]; intros best F; cbn in F; [auto|]. destruct (IH _ F) as [E _].
      unfold nearer in E; destruct best as [first|]; [destruct (is_nearer rl first p)|]; discriminate. }
    destruct (G _ _ H) as [_ F]. destruct (served q) eqn:S; [reflexivity | exfalso].
    assert (In q (filter (fun q => negb (served q)) l)) as J by (apply filter_In; split; [exact I | now rewrite S]).
    now rewrite F in J.
  Qed.
End Step.

(** ** What every input keeps *)

(** It has one record of a WFR; if it is free it is done with all that it knows; what it asks for it is not done
    with. *)
Record inv (rl : rule) (x : robot) : Prop := {
  once : NoDup (map about (requests x));
  free_done : doing x = Free -> forall q, In q (requests x) -> served q = true;
  asks_open : forall w e k, doing x = Asking w e k -> exists q, record_of x w = Some q /\ served q = false
    /\ (epochs rl = true -> epoch q = e);
}.

(** It may ask, after it has become [z]. *)
Lemma asks_inv : forall rl z, NoDup (map about (requests z)) ->
  (forall w e k, doing z = Asking w e k -> exists q, record_of z w = Some q /\ served q = false
    /\ (epochs rl = true -> epoch q = e)) -> inv rl (fst (asks rl z)).
Proof.
  intros rl z N A; unfold asks; destruct (doing z) as [|v f j|v f] eqn:D.
  2,3: constructor; cbn [fst]; [exact N | congruence | rewrite D; exact A].
  destruct (nearest rl (requests z)) as [q|] eqn:Q; constructor; cbn [fst requests doing]; try exact N; try congruence.
  - intros w e k [= <- <- <-]. apply nearest_in in Q; destruct Q as [I S]. exists q; repeat split; auto.
    unfold record_of; cbn [requests]. now apply one_record.
  - intros _; now apply (none_nearest rl).
Qed.

Lemma serve_free : forall w l, (forall q, In q l -> served q = true) -> forall q, In q (serve w l) -> served q = true.
Proof.
  intros w l F q I; unfold serve, change in I; apply in_map_iff in I; destruct I as [p [<- P]].
  destruct (is_about w p); [reflexivity | now apply F].
Qed.

Lemma serve_other : forall rl x w l, inv rl x -> l = requests x ->
  forall v e k, doing x = Asking v e k -> v <> w ->
  exists q, find (is_about v) (serve w l) = Some q /\ served q = false /\ (epochs rl = true -> epoch q = e).
Proof.
  intros rl x w l V -> v e k D N; destruct (asks_open _ _ V v e k D) as [q Q]; exists q.
  rewrite serve_record. apply Nat.eqb_neq in N; now rewrite N.
Qed.

Lemma notes_open : forall rl room x heard, served heard = false -> inv rl x ->
  forall w e k, doing (notes rl room x heard) = Asking w e k ->
  exists q, record_of (notes rl room x heard) w = Some q /\ served q = false /\ (epochs rl = true -> epoch q = e).
Proof.
  intros rl room x heard F V w e k D; unfold notes in *.
  destruct (record_of x (about heard)) as [p|] eqn:R; cbn [doing] in D; unfold record_of; cbn [requests].
  - rewrite find_change by (intros; now apply about_noted).
    assert (doing x = Asking w e k /\ (w = about heard -> epochs rl && (epoch p <? epoch heard) = false)) as [A Old].
    { destruct (epochs rl && (epoch p <? epoch heard)) eqn:E; cbn [andb] in D; [|auto].
      destruct (is_own (doing x) (about heard)) eqn:O; [discriminate|]. split; [exact D|]. intros ->.
      rewrite D in O; cbn in O; now rewrite Nat.eqb_refl in O. }
    destruct (asks_open _ _ V w e k A) as [q [Q [S E]]]. destruct (Nat.eqb_spec w (about heard)) as [->|N];
      [|now exists q].
    unfold record_of in Q, R; rewrite R in *; injection Q as ->. cbn [option_map].
    exists (noted rl q heard); split; [reflexivity|]. unfold noted; rewrite (Old eq_refl).
    destruct (epochs rl) eqn:T; cbn [andb]; [|split; [exact S | discriminate]].
    destruct (Nat.eqb_spec (epoch q) (epoch heard)) as [G|G]; cbn [negb served epoch]; [|auto].
    split; [exact S|]. intros _; rewrite <- G, Nat.max_id; auto.
  - destruct (asks_open _ _ V w e k D) as [q [Q [S E]]]; exists q; split; [|auto]. unfold adds.
    pose proof (no_record _ _ R) as A. destruct (_ <? _).
    + rewrite find_append by exact A. destruct (Nat.eqb_spec (about heard) w) as [<-|_]; [unfold record_of in *;
        congruence | exact Q].
    + destruct (gives_way_facts (is_own (doing x)) heard (requests x) A (once _ _ V)) as [_ [_ [G _]]].
      rewrite G; [exact Q | rewrite D; cbn; apply Nat.eqb_refl | intros ->; unfold record_of in *; congruence].
Qed.

Lemma inv_step : forall rl me room x i, inv rl x -> inv rl (fst (robot_step rl me room x i)).
Proof.
  intros rl me room x i V; pose proof (once_step rl me room x i (once _ _ V)) as N.
  assert (forall l, map about l = map about (requests x) -> inv rl (fst (asks rl {| requests := l;
    doing := Free |}))) as Freed.
  { intros l E; apply asks_inv; cbn; [rewrite E; apply V | discriminate]. }
  destruct i as [w e h s|w e to c| | |w e]; cbn [robot_step] in *.
  - apply asks_inv; [now apply notes_once, V | now apply notes_open].
  - destruct (to =? me); [|exact V]. unfold heeds in *. destruct (record_of x w) as [q|]; [|exact V].
    destruct (_ && _); [exact V|].
    destruct (match c with Some c => c =? me | None => false end).
    + constructor; cbn [fst requests doing].
      * now rewrite serve_about; apply V.
      * destruct (_ || _ || _); [discriminate|]. intros F; apply serve_free, (free_done _ _ V F).
      * intros v f k D. destruct (doing x) as [|v' f' k'|v' f'] eqn:X; destruct (_ || _ || _) eqn:T; try discriminate.
        injection D as -> -> ->. apply (serve_other rl x w _ V eq_refl v f k X). intros ->. now rewrite Nat.eqb_refl
          in T.
    + apply asks_inv; cbn [requests doing]; [now rewrite serve_about; apply V|].
      intros v f k D. destruct (doing x) as [|v' f' k'|v' f'] eqn:X; destruct (_ || _) eqn:T; try discriminate.
      injection D as -> -> ->. apply (serve_other rl x w _ V eq_refl v f k X). intros ->. now rewrite Nat.eqb_refl in T.
  - destruct (doing x) as [|w e [|k]|] eqn:D; try exact V; destruct (repetition rl); try exact V.
    + apply Freed, serve_about.
    + constructor; cbn [fst requests doing]; [apply V | discriminate|]. intros v f j [= <- <- <-]. apply (asks_open _
        _ V _ _ _ D).
  - destruct (doing x) eqn:D; try (now apply Freed); apply asks_inv; try apply V.
  - destruct (doing x) eqn:D; try exact V. destruct (_ && _); [now apply Freed | exact V].
Qed.

Lemma inv_always : forall rl me room ins, inv rl (robot_after rl me room ins).
Proof.
  intros rl me room ins; induction ins as [|i ins IH] using rev_ind.
  - constructor; cbn; [constructor | contradiction | discriminate].
  - unfold robot_after; rewrite after_snoc. now apply inv_step.
Qed.
