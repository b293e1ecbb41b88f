(** MRC-6, MRC-10, MRC-12 and MRC-14, repaired, of a robot that hears anything in any order: what it records, and what
    it is done with. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines Robots.
Import ListNotations.

(** ** MRC-6 *)

(** A robot that hears a call which is newer than the one that it knows of has its SBit clear. *)
Theorem MRC_6 : forall me room x w e h s, (forall q, record_of x w = Some q -> epoch q < e) ->
  forall y out, robot_step REPAIRED me room x (Notice w e h s) = (y, out) ->
  forall q, record_of y w = Some q -> served q = false.
Proof.
  intros me room x w e h s New y out H q; replace y with (fst (robot_step REPAIRED me room x (Notice w e h s)))
    by now rewrite H.
  unfold record_of; rewrite requests_after; unfold notes; cbn [about].
  destruct (record_of x w) as [p|] eqn:R; cbn [requests].
  - rewrite find_change by (intros; now apply about_noted). unfold record_of in R; rewrite Nat.eqb_refl, R;
      cbn [option_map].
    unfold noted; cbn [epochs REPAIRED andb epoch].
    replace (epoch p <? e) with true by (symmetry; apply Nat.ltb_lt; now apply New). now intros [= <-].
  - intros F; apply find_some in F; destruct F as [I A]; unfold is_about in A; apply Nat.eqb_eq in A.
    apply no_record in R. assert (In q (requests x) -> False) as Old by (intros J; apply R; rewrite <- A;
      now apply in_map).
    unfold adds in I; destruct (_ <? _).
    + apply in_app_or in I; destruct I as [I|[<-|[]]]; [now apply Old in I | reflexivity].
    + assert (forall k, In q (gives_way (is_own (doing x)) {| about := w; epoch := e; served := false; hops := S h;
        parent := s |} k) ->
        q = {| about := w; epoch := e; served := false; hops := S h; parent := s |} \/ In q k) as G.
      { induction k as [|p k IH]; cbn; [auto|]. destruct (_ && _); cbn; intros [<-|J]; auto. destruct (IH J); auto. }
      destruct (G _ I) as [->|J]; [reflexivity | now apply Old in J].
Qed.

(** ** MRC-10 *)

(** What the NOTICEs of WFR [w] that it has heard make of their first hearer, in order: the call, one hop more than
    the NOTICE has, and the node that told it so. *)
Definition told (i : robot_input) (w : nat) : list request :=
  match i with
  | Notice v e h s => if v =? w then [{| about := w; epoch := e; served := false; hops := S h; parent := s |}] else []
  | _ => []
  end.
Definition notices (w : nat) (ins : list robot_input) : list request := flat_map (fun i => told i w) ins.

(** The first of the fewest hops under the newest call. *)
Definition is_due (l : list request) (n : request) : Prop :=
  exists before later, l = before ++ n :: later
  /\ (forall p, In p l -> epoch p < epoch n \/ (epoch p = epoch n /\ hops n <= hops p))
  /\ (forall p, In p before -> epoch p = epoch n -> hops n < hops p).

(** It has heard of no more WFRs than it has room for. *)
Definition has_room (room : nat) (ins : list robot_input) : Prop := at_most room (fun w => notices w ins <> []).

Definition says_so (q n : request) : Prop := epoch q = epoch n /\ hops q = hops n /\ parent q = parent n.

Definition recorded (x : robot) (ins : list robot_input) : Prop :=
  forall w, match record_of x w with
            | Some q => exists n, is_due (notices w ins) n /\ says_so q n
            | None => notices w ins = []
            end.

Lemma notices_snoc : forall w ins i, notices w (ins ++ [i]) = notices w ins ++ told i w.
Proof. intros; unfold notices; rewrite flat_map_app; cbn; now rewrite app_nil_r. Qed.

Lemma has_room_before : forall room ins i, has_room room (ins ++ [i]) -> has_room room ins.
Proof.
  intros room ins i R l N A; apply R; [exact N|]. intros w I E; apply (A w I).
  rewrite notices_snoc in E. now apply app_eq_nil in E.
Qed.

(** A new WFR finds room. *)
Lemma room_left : forall room x ins w e h s, has_room room (ins ++ [Notice w e h s]) -> inv REPAIRED x -> recorded x
  ins ->
  record_of x w = None -> length (requests x) <? room = true.
Proof.
  intros room x ins w e h s R V Rec N; apply Nat.ltb_lt.
  assert (length (w :: map about (requests x)) <= room) as L; [|cbn in L; rewrite map_length in L; exact L].
  apply R; [constructor; [now apply no_record | apply V]|]. intros v [<-|I]; rewrite notices_snoc.
  - cbn; rewrite Nat.eqb_refl; intros E; apply app_eq_nil in E; now destruct E.
  - apply in_map_iff in I; destruct I as [q [<- I]]. specialize (Rec (about q)).
    unfold record_of in Rec; rewrite (one_record _ _ (once _ _ V) I) in Rec.
    destruct Rec as [n [[before [later [-> _]]] _]]. intros E; apply app_eq_nil in E; destruct E as [E _].
    now destruct before.
Qed.

Lemma due_newer : forall l n m, is_due l n -> epoch n < epoch m -> is_due (l ++ [m]) m.
Proof.
  intros l n m [before [later [-> [A B]]]] L; exists (before ++ n :: later), []; repeat split.
  - intros p I; apply in_app_or in I; destruct I as [I|[<-|[]]]; [destruct (A p I); lia | lia].
  - intros p I E; destruct (A p I); lia.
Qed.

Lemma due_older : forall l n m, is_due l n -> epoch m < epoch n \/ (epoch m = epoch n /\ hops n <= hops m) -> is_due
  (l ++ [m]) n.
Proof.
  intros l n m [before [later [-> [A B]]]] L; exists before, (later ++ [m]); rewrite <- app_assoc; repeat split; auto.
  intros p I; rewrite app_assoc in I. apply in_app_or in I; destruct I as [I|[<-|[]]]; [now apply A | exact L].
Qed.

Lemma due_nearer : forall l n m, is_due l n -> epoch m = epoch n -> hops m < hops n -> is_due (l ++ [m]) m.
Proof.
  intros l n m [before [later [-> [A B]]]] E L; exists (before ++ n :: later), []; repeat split.
  - intros p I; apply in_app_or in I; destruct I as [I|[<-|[]]]; [destruct (A p I); lia | lia].
  - intros p I F; destruct (A p I); lia.
Qed.

Lemma recorded_step : forall me room x ins i, has_room room (ins ++ [i]) -> inv REPAIRED x -> recorded x ins ->
  recorded (fst (robot_step REPAIRED me room x i)) (ins ++ [i]).
Proof.
  intros me room x ins i R V Rec w; rewrite notices_snoc; unfold record_of; rewrite requests_after.
  pose proof (Rec w) as W; unfold record_of in W.
  assert (forall o, match find (is_about w) (match o with Some v => serve v (requests x) | None => requests x end) with
    | Some q => exists n, is_due (notices w ins) n /\ says_so q n | None => notices w ins = [] end) as Bits.
  { intros [v|]; [|exact W]. rewrite serve_record. destruct (w =? v); [|exact W].
    destruct (find (is_about w) (requests x)) as [q|]; cbn [option_map]; [|exact W].
    destruct W as [n [D S]]; exists n; split; [exact D | exact S]. }
  destruct i as [v e h s|v e to c| | |v e]; cbn [told]; try (rewrite app_nil_r; apply Bits).
  set (m := {| about := v; epoch := e; served := false; hops := S h; parent := s |}).
  unfold notes; change (about m) with v. pose proof (Rec v) as Rv. destruct (record_of x v) as [q|] eqn:F;
    cbn [requests].
  - rewrite find_change by (intros; now apply about_noted). rewrite (Nat.eqb_sym w v).
    destruct (Nat.eqb_spec v w) as [<-|D]; [|rewrite app_nil_r; exact W].
    unfold record_of in F; rewrite F; cbn [option_map]. fold m. destruct Rv as [n [D [E [H P]]]].
    unfold noted; cbn [epochs REPAIRED andb]. change (epoch m) with e; change (hops m) with (S h).
    destruct (Nat.ltb_spec (epoch q) e) as [L|L].
    { exists m; split; [apply (due_newer _ n); [exact D | change (epoch m) with e; lia] | repeat split]. }
    destruct (Nat.eqb_spec (epoch q) e) as [G|G]; cbn [negb].
    2:{ exists n; split; [|now repeat split]. apply due_older; [exact D|]. left; change (epoch m) with e; lia. }
    rewrite G, Nat.max_id. destruct (Nat.ltb_spec (S h) (hops q)) as [C|C].
    + exists m; split; [|now repeat split]. apply (due_nearer _ n); auto; change (epoch m) with e;
        change (hops m) with (S h); lia.
    + exists n; split; [|repeat split; cbn [epoch hops parent]; congruence].
      apply due_older; [exact D|]. right; change (epoch m) with e; change (hops m) with (S h); lia.
  - unfold adds; rewrite (room_left room x ins v e h s R V Rec F). rewrite find_append by now apply no_record.
    change (about m) with v. destruct (Nat.eqb_spec v w) as [<-|D]; [|rewrite app_nil_r; exact W].
    rewrite Rv; fold m; exists m; split; [|now repeat split]. exists [], []; repeat split; [|contradiction].
    intros p [<-|[]]; right; split; lia.
Qed.

Lemma recorded_always : forall me room ins, has_room room ins -> recorded (robot_after REPAIRED me room ins) ins.
Proof.
  intros me room ins; induction ins as [|i ins IH] using rev_ind; intros R; [intros w; reflexivity|].
  unfold robot_after; rewrite after_snoc. apply recorded_step;
    [exact R | apply inv_always | now apply IH, (has_room_before _ _ i)].
Qed.

(** Of each WFR it has the newest call that it has heard, one hop more than the fewest under it, and the first node
    that told it so; and it bids by that. *)
Theorem MRC_10 : forall me room ins, has_room room ins ->
  (forall w, match record_of (robot_after REPAIRED me room ins) w with
             | Some q => exists n, is_due (notices w ins) n /\ says_so q n
             | None => notices w ins = []
             end)
  /\ (forall i y m h, robot_step REPAIRED me room (robot_after REPAIRED me room ins) i = (y, Some m) -> says m = Move
    h ->
      exists q, record_of y (to_wfr m) = Some q /\ m = bids q).
Proof.
  intros me room ins R; split; [now apply recorded_always|]. intros i y m h H M.
  set (x := robot_after REPAIRED me room ins) in *. pose proof (inv_always REPAIRED me room ins : inv REPAIRED x) as V.
  assert (forall z, asks REPAIRED z = (y, Some m) -> NoDup (map about (requests z)) ->
    exists q, record_of y (to_wfr m) = Some q /\ m = bids q) as A.
  { intros z A N; unfold asks in A; destruct (doing z); try discriminate.
    destruct (nearest REPAIRED (requests z)) as [q|] eqn:Q; [|discriminate]. injection A as <- <-. exists q; split;
      [|reflexivity].
    apply nearest_in in Q. unfold record_of; cbn [requests to_wfr bids]. now apply one_record. }
  clearbody x; destruct i as [w e k s|w e to c| | |w e]; cbn [robot_step] in H.
  - apply (A _ H). now apply notes_once, V.
  - destruct (to =? me); [|discriminate]. unfold heeds in H. destruct (record_of x w) as [q|]; [|discriminate].
    destruct (_ && _); [discriminate|]. destruct (match c with Some c => c =? me | None => false end).
    + cbn [consent REPAIRED] in H; injection H as <- <-; cbn [says] in M. destruct (_ || _) in M; discriminate.
    + apply (A _ H); cbn [requests]. now rewrite serve_about; apply V.
  - destruct (doing x) as [|w e [|k]|] eqn:D; try discriminate; cbn [repetition REPAIRED] in H.
    + apply (A _ H); cbn [requests]. now rewrite serve_about; apply V.
    + destruct (record_of x w) as [q|] eqn:Q; [|discriminate]. injection H as <- <-; exists q; split; [|reflexivity].
      destruct (record_in _ _ _ Q) as [_ <-]. exact Q.
  - destruct (doing x); apply (A _ H); apply V.
  - destruct (doing x); try discriminate. destruct (_ && _); [apply (A _ H); apply V | discriminate].
Qed.

(** ** MRC-12 *)

(** It is told whom the WFR has chosen for that call, or asks for the call, and nobody has answered its last MOVE;
    and it has heard of the call before. *)
Definition settles (me room w e : nat) (before : list robot_input) (i : robot_input) : Prop :=
  (exists n, In n (notices w before) /\ epoch n = e)
  /\ ((exists c, i = Tells w e me c) \/ (i = Waited /\ doing (robot_after REPAIRED me room before) = Asking w e 0)).

Definition settled (me room w e : nat) (ins : list robot_input) : Prop :=
  exists before i later, ins = before ++ i :: later /\ settles me room w e before i.

Lemma settled_snoc : forall me room w e ins i,
  settled me room w e (ins ++ [i]) <-> settled me room w e ins \/ settles me room w e ins i.
Proof.
  intros me room w e ins i; split.
  - intros [before [j [later [E S]]]]. destruct later as [|k l] using rev_ind; [|clear IHl].
    + apply app_inj_tail in E; destruct E as [-> ->]; auto.
    + left; exists before, j, l; split; [|exact S]. rewrite app_comm_cons, app_assoc in E.
      now apply app_inj_tail in E.
  - intros [[before [j [later [-> S]]]]|S].
    + exists before, j, (later ++ [i]); split; [now rewrite <- app_assoc | exact S].
    + exists ins, i, []; auto.
Qed.

(** The SBit of the newest call is set if it was told whom the WFR has chosen, or has asked in vain, and else clear. *)
Theorem MRC_12 : forall me room ins, has_room room ins ->
  forall w q, record_of (robot_after REPAIRED me room ins) w = Some q ->
  (served q = true <-> settled me room w (epoch q) ins).
Proof.
  intros me room ins; induction ins as [|i ins IH] using rev_ind; intros R w q; [discriminate|].
  pose proof (has_room_before _ _ _ R) as R'. specialize (IH R').
  pose proof (recorded_always me room ins R') as Rec. pose proof (inv_always REPAIRED me room ins) as V.
  unfold robot_after at 1; rewrite after_snoc. fold (robot_after REPAIRED me room ins).
  set (x := robot_after REPAIRED me room ins) in *. unfold record_of; rewrite requests_after, settled_snoc; intros H.
  (* what it knows of the call it was told of *)
  assert (forall p, record_of x w = Some p -> exists n, In n (notices w ins) /\ epoch n = epoch p) as Heard.
  { intros p P; specialize (Rec w); rewrite P in Rec. destruct Rec as [n [[b [l [E _]]] [F _]]]. exists n; split;
      [|auto].
    rewrite E; apply in_or_app; right; now left. }
  assert (forall p n, record_of x w = Some p -> In n (notices w ins) -> epoch n <= epoch p) as Newest.
  { intros p n P I; specialize (Rec w); rewrite P in Rec. destruct Rec as [m [[b [l [E [A _]]]] [F _]]].
    destruct (A n I); lia. }
  assert (forall o, (forall p, record_of x w = Some p -> o = Some w <-> settles me room w (epoch p) ins i) ->
    find (is_about w) (match o with Some v => serve v (requests x) | None => requests x end) = Some q ->
    (served q = true <-> settled me room w (epoch q) ins \/ settles me room w (epoch q) ins i)) as Bits.
  { intros o O F. assert (forall v, v <> w -> Some v = Some w -> False) as Ne by (intros; congruence).
    destruct o as [v|]; [rewrite serve_record in F; destruct (Nat.eqb_spec w v) as [<-|D]|].
    - change (option_map set_bit (record_of x w) = Some q) in F.
      destruct (record_of x w) as [p|] eqn:P; [|discriminate]. injection F as <-.
      cbn [served epoch set_bit]; split; [|reflexivity]. intros _; right; now apply (O p).
    - change (record_of x w = Some q) in F. rewrite (IH w q F). split; [auto|]. intros [S|S]; [exact S|].
      apply (O q F) in S; congruence.
    - change (record_of x w = Some q) in F. rewrite (IH w q F). split; [auto|]. intros [S|S]; [exact S|].
      apply (O q F) in S; congruence. }
  assert (forall e, (forall c, i <> Tells w e me c) -> (i = Waited -> False) -> ~ settles me room w e ins i) as Not.
  { intros e A B [_ [[c C]|[C _]]]; [now apply A in C | now apply B in C]. }
  destruct i as [v e h s|v e to c| | |v e].
  - assert (served q = true <-> settled me room w (epoch q) ins) as G;
      [|rewrite G; split; [auto|]; intros [S|S]; [exact S | now apply Not in S]].
    set (m := {| about := v; epoch := e; served := false; hops := S h; parent := s |}) in *.
    unfold notes in H; change (about m) with v in H. destruct (record_of x v) as [p|] eqn:F; cbn [requests] in H.
    + rewrite find_change in H by (intros; now apply about_noted).
      destruct (Nat.eqb_spec w v) as [<-|D]; [|now apply IH]. unfold record_of in F; rewrite F in H; injection H as <-.
      change (record_of x w = Some p) in F. unfold noted; cbn [epochs REPAIRED andb]. change (epoch m) with e.
      destruct (Nat.ltb_spec (epoch p) e) as [L|L].
      { cbn [served epoch m]; split; [discriminate|]. intros [b [j [l [-> [[n [I E]] _]]]]]. exfalso.
        assert (epoch n <= epoch p); [|lia]. apply (Newest p n F).
        unfold notices in *; rewrite flat_map_app; apply in_or_app; now left. }
      destruct (Nat.eqb_spec (epoch p) e) as [G|G]; cbn [negb]; [|now apply IH].
      cbn [served epoch]; rewrite <- G, Nat.max_id; now apply IH.
    + unfold adds in H; rewrite (room_left room x ins v e h s R V Rec F) in H.
      rewrite find_append in H by now apply no_record. change (about m) with v in H.
      destruct (Nat.eqb_spec v w) as [->|D]; [|now apply IH]. injection H as <-. cbn [served epoch m]; split;
        [discriminate|].
      intros [b [j [l [-> [[n [I E]] _]]]]]. exfalso. specialize (Rec w); rewrite F in Rec.
      unfold notices in *; rewrite flat_map_app in Rec; apply app_eq_nil in Rec; destruct Rec as [Rec _];
        now rewrite Rec in I.
  - refine (Bits _ _ H). intros p P; cbn [set_by]. split.
    + intros S. destruct (record_of x v) as [p'|] eqn:F; [|discriminate].
      destruct (Nat.eqb_spec to me) as [->|]; [|discriminate]. cbn [epochs REPAIRED andb] in S.
      destruct (Nat.eqb_spec (epoch p') e) as [G|]; [|discriminate]. injection S as ->.
      rewrite P in F; injection F as ->. split; [now apply Heard | left; rewrite G; eauto].
    + intros [_ [[c' [= -> -> -> ->]]|[[=] _]]]. rewrite P, Nat.eqb_refl;
        cbn [epochs REPAIRED andb]. now rewrite Nat.eqb_refl.
  - refine (Bits _ _ H). intros p P; cbn [set_by repetition REPAIRED]. split.
    + intros S. destruct (doing x) as [|v e [|k]|] eqn:D; try discriminate. injection S as ->.
      destruct (asks_open _ _ V _ _ _ D) as [p' [P' [_ E]]]; rewrite P in P'; injection P' as <-.
      split; [now apply Heard | right; split; [reflexivity|]]. fold x; rewrite (E eq_refl); exact D.
    + intros [_ [[c [=]]|[_ D]]]. fold x in D; now rewrite D.
  - refine (Bits None _ H). intros p P; split; [discriminate|]. intros S; now apply Not in S.
  - refine (Bits None _ H). intros p P; split; [discriminate|]. intros S; now apply Not in S.
Qed.

(** ** MRC-14 *)

(** It is done with the WFR of a record, whose lease it does not hold. *)
Definition may_go (x : robot) (p : request) : Prop := served p = true /\ forall e, doing x <> Leased (about p) e.

Lemma gives_way_first : forall own q l,
  (exists before p later, l = before ++ p :: later /\ served p = true /\ own (about p) = false
     /\ (forall r, In r before -> served r = true -> own (about r) = true) /\ gives_way own q l = before ++ q :: later)
  \/ ((forall r, In r l -> served r = true -> own (about r) = true) /\ gives_way own q l = l).
Proof.
  intros own q l; induction l as [|p l IH]; cbn [gives_way]; [right; split; [contradiction | reflexivity]|].
  destruct (served p && negb (own (about p))) eqn:E.
  - apply andb_true_iff in E; destruct E as [S O]; apply negb_true_iff in O.
    left; exists [], p, l; repeat split; auto; contradiction.
  - assert (served p = true -> own (about p) = true) as P.
    { intros S; rewrite S in E; now apply negb_false_iff in E. }
    destruct IH as [[before [r [later [-> [S [O [B ->]]]]]]]|[B ->]].
    + left; exists (p :: before), r, later; repeat split; auto. intros r' [<-|I]; auto.
    + right; split; [|reflexivity]. intros r [<-|I]; auto.
Qed.

(** A robot whose records are full, and that has none of WFR [w], puts it in the place of the first that may go. If
    there is none, it is as if it had not heard of it. *)
Theorem MRC_14 : forall me room ins w e h s,
  room <= length (requests (robot_after REPAIRED me room ins)) -> record_of (robot_after REPAIRED me room ins) w = None
    ->
  forall y out, robot_step REPAIRED me room (robot_after REPAIRED me room ins) (Notice w e h s) = (y, out) ->
  (exists before p later, requests (robot_after REPAIRED me room ins) = before ++ p :: later
     /\ may_go (robot_after REPAIRED me room ins) p
     /\ (forall q, In q before -> ~ may_go (robot_after REPAIRED me room ins) q)
     /\ requests y = before ++ {| about := w; epoch := e; served := false; hops := S h; parent := s |} :: later)
  \/ ((forall q, In q (requests (robot_after REPAIRED me room ins)) -> ~ may_go (robot_after REPAIRED me room ins) q)
      /\ y = robot_after REPAIRED me room ins /\ out = None).
Proof.
  intros me room ins w e h s Full New y out H. pose proof (inv_always REPAIRED me room ins) as V.
  set (x := robot_after REPAIRED me room ins) in *. clearbody x.
  set (heard := {| about := w; epoch := e; served := false; hops := S h; parent := s |}) in *.
  assert (forall q, In q (requests x) -> served q = true -> (is_own (doing x) (about q) = true <-> ~ may_go x q)) as
    Own.
  { intros q I S; unfold may_go; destruct (doing x) as [|v f k|v f] eqn:D; cbn [is_own].
    - split; [discriminate|]. intros M; exfalso; apply M; split; [exact S | discriminate].
    - destruct (asks_open _ _ V _ _ _ D) as [p [P [U _]]]. destruct (Nat.eqb_spec v (about q)) as [->|N].
      + unfold record_of in P; rewrite (one_record _ _ (once _ _ V) I) in P; congruence.
      + split; [discriminate|]. intros M; exfalso; apply M; split; [exact S | discriminate].
    - destruct (Nat.eqb_spec v (about q)) as [->|N].
      + split; [|reflexivity]. intros _ [_ M]; now apply (M f).
      + split; [discriminate|]. intros M; exfalso; apply M; split; [exact S | intros g; congruence]. }
  assert (requests y = gives_way (is_own (doing x)) heard (requests x)) as Y.
  { replace y with (fst (robot_step REPAIRED me room x (Notice w e h s))) by now rewrite H.
    rewrite requests_after; fold heard; unfold notes; change (about heard) with w; rewrite New; cbn [requests]. unfold
      adds.
    now replace (length (requests x) <? room) with false by (symmetry; now apply Nat.ltb_ge). }
  destruct (gives_way_first (is_own (doing x)) heard (requests x)) as [[before [p [later [E [S [O [B G]]]]]]]|[B G]].
  - left; exists before, p, later; rewrite Y, G. repeat split; [exact E | exact S | | ].
    + intros f D; rewrite D in O; cbn in O; now rewrite Nat.eqb_refl in O.
    + intros q I M; assert (In q (requests x)) as J by (rewrite E; apply in_or_app; now left).
      destruct M as [T M]; apply (Own q J T); [now apply B | now split].
  - right. assert (forall q, In q (requests x) -> ~ may_go x q) as None_.
    { intros q I M; destruct M as [T M]; apply (Own q I T); [now apply B | now split]. }
    split; [exact None_|].
    assert (notes REPAIRED room x heard = x) as Same.
    { unfold notes; change (about heard) with w; rewrite New; unfold adds.
      replace (length (requests x) <? room) with false by (symmetry; now apply Nat.ltb_ge). rewrite G; now destruct x. }
    cbn [robot_step] in H; fold heard in H; rewrite Same in H. unfold asks in H.
    destruct (doing x) eqn:D; try (now injection H as <- <-).
    destruct (nearest REPAIRED (requests x)) as [q|] eqn:Q; [|now injection H as <- <-].
    apply nearest_in in Q; destruct Q as [I U]. rewrite (free_done _ _ V D q I) in U; discriminate.
Qed.

(** ** What is needed *)

(** Without Epochs the hops may be those of an older call. *)
Theorem without_Epochs_breaks_MRC_10 : exists ins q, record_of (robot_after without_Epochs 1 9 ins) 1 = Some q
  /\ Forall (fun n => ~ says_so q n) (notices 1 ins).
Proof.
  exists [Notice 1 1 2 5; Notice 1 2 4 6]; eexists; split; [vm_compute; reflexivity|].
  repeat constructor; unfold says_so; cbn; intros [E [H P]]; discriminate.
Qed.

(** A robot that has no room for a second WFR forgets the first one, which it is done with, or does not hear of the
    second. *)
Theorem without_room_breaks_MRC_10_and_MRC_12 :
  (exists ins, record_of (robot_after REPAIRED 1 1 ins) 2 = None /\ notices 2 ins <> [])
  /\ exists ins q, record_of (robot_after REPAIRED 1 1 ins) 1 = Some q /\ served q = true
     /\ record_of (fst (robot_step REPAIRED 1 1 (robot_after REPAIRED 1 1 ins) (Notice 2 1 1 5))) 1 = None.
Proof.
  split; [exists [Notice 1 1 1 5; Notice 2 1 1 5]; split; vm_compute; congruence|].
  exists [Notice 1 1 1 5; Tells 1 1 1 None]; eexists; repeat split; vm_compute; reflexivity.
Qed.
