(** MRC-3 and MRC-9, repaired, of a WFR that hears anything in any order: it chooses the best of the MOVEs of its
    window, and tells that to those who have sent them, and to no other. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines.
Import ListNotations.

Section Choices.
  Variables (rl : rule) (me room : nat).

  Definition wfr_after : list wfr_input -> wfr := after (wfr_step rl me room) (fresh_wfr).

  (** A MOVE of its present call. *)
  Definition own_move (x : wfr) (i : wfr_input) : option bid :=
    match i with
    | Says w e r (Move h) => if (w =? me) && (e =? call x) then Some {| mhc := h; mid := r |} else None
    | _ => None
    end.

  (** The MOVEs of its present call that it received while its window was open: after it called, before it chose. *)
  Definition hears_in_window (x : wfr) (l : list bid) (i : wfr_input) : list bid :=
    match own_move x i, stage x with
    | Some b, Collecting _ => l ++ [b]
    | _, _ => if existsb (fun m => match m with Calls _ => true | Resb _ _ _ => false end)
                   (snd (wfr_step rl me room x i)) then [] else l
    end.
  Definition in_window (l : list wfr_input) : list bid :=
    snd (fold_left (fun s i => (fst (wfr_step rl me room (fst s) i), hears_in_window (fst s) (snd s) i))
           l (fresh_wfr, [])).

  (** On whom it has decided. *)
  Definition choice_of (x : wfr) : option bid :=
    match stage x with Offered c _ | CountsOn c => Some c | Idle | Collecting _ | Rescued => None end.

  (** The least (MHC, MID). *)
  Definition is_best (c : bid) (l : list bid) : Prop :=
    In c l /\ forall b, In b l -> mhc c < mhc b \/ (mhc c = mhc b /\ mid c <= mid b).
End Choices.

(** ** What every input keeps *)

Lemma in_window_snoc : forall rl me room l i, in_window rl me room (l ++ [i]) =
  hears_in_window rl me room (wfr_after rl me room l) (in_window rl me room l) i.
Proof.
  intros rl me room l i; unfold in_window; rewrite fold_left_app; cbn [fold_left fst snd]. f_equal.
  unfold wfr_after, after. generalize (fresh_wfr) as x, (@nil bid) as k.
  induction l as [|j l IH]; intros x k; cbn [fold_left fst snd]; [reflexivity | apply IH].
Qed.

Lemma after_snoc : forall (S I O : Type) (step : S -> I -> S * O) x l i,
  after step x (l ++ [i]) = fst (step (after step x l) i).
Proof. intros; unfold after; now rewrite fold_left_app. Qed.

(** The best so far and the choice are the best of the window; who is remembered has asked, and who is not, found
    no room. *)
Record inv (room : nat) (x : wfr) (l : list bid) : Prop := {
  idle_unheard : stage x = Idle -> l = [];
  nobody_yet : stage x = Collecting None -> l = [];
  best_so_far : forall b, stage x = Collecting (Some b) -> is_best b l;
  choice_best : forall c, choice_of x = Some c -> is_best c l;
  asked_once : NoDup (asked x);
  asked_heard : forall r, In r (asked x) -> In r (map mid l);
  heard_asked : forall b, In b l -> In (mid b) (asked x) \/ room <= length (asked x);
}.

Lemma best_of_more : forall b c l, is_best b l -> is_best (better REPAIRED b c) (l ++ [c]).
Proof.
  intros b c l [I B]; unfold better, is_better; cbn [nearest_robot least_identity REPAIRED andb].
  destruct (Nat.eqb_spec (mhc b) (mhc c)); cbn [negb];
    [destruct (Nat.ltb_spec (mid c) (mid b)) | destruct (Nat.ltb_spec (mhc c) (mhc b))];
    (split; [apply in_or_app; cbn; auto|]; intros d D; apply in_app_or in D; destruct D as [D|[<-|[]]];
     [apply B in D | ]; lia).
Qed.

Lemma best_of_one : forall c, is_best c [c].
Proof. intros c; split; [now left | intros b [<-|[]]; lia]. Qed.

Lemma inv_calls : forall room e, inv room {| call := e; stage := Collecting None; asked := [] |} [].
Proof. intros room e; constructor; cbn; try discriminate; try contradiction; auto; constructor. Qed.

(** Another stage of which the same is to be shown. *)
Lemma inv_at : forall room x l p, inv room x l ->
  (p = Idle -> l = []) -> (p = Collecting None -> l = []) ->
  (forall b, p = Collecting (Some b) -> is_best b l) ->
  (forall c, choice_of (at_phase x p) = Some c -> is_best c l) -> inv room (at_phase x p) l.
Proof. intros room x l p [A B C D E F G] H1 H2 H3 H4; constructor; auto. Qed.

Lemma inv_step : forall me room x l i, inv room x l ->
  inv room (fst (wfr_step REPAIRED me room x i)) (hears_in_window REPAIRED me room x l i).
Proof.
  intros me room x l i V.
  assert (own_move me x i = None \/ (forall b, stage x <> Collecting b) ->
    hears_in_window REPAIRED me room x l i =
      if existsb (fun m => match m with Calls _ => true | Resb _ _ _ => false end)
        (snd (wfr_step REPAIRED me room x i)) then [] else l) as Shut.
  { unfold hears_in_window; intros [H|H]; [now rewrite H|].
    destruct (own_move me x i); [|reflexivity]. destruct (stage x) eqn:E; try reflexivity. now destruct (H best). }
  assert (forall e, inv room (fst (calls e)) []) as New by (intros; apply inv_calls).
  destruct i as [|w e r [h| |]| |].
  - rewrite Shut by (left; reflexivity). cbn. destruct (stage x) eqn:P; cbn; try exact V; apply New.
  - destruct ((w =? me) && (e =? call x)) eqn:M.
    + assert (own_move me x (Says w e r (Move h)) = Some {| mhc := h; mid := r |}) as Own by (cbn; now rewrite M).
      destruct (stage x) as [|best|c k|c|] eqn:P.
      2:{ unfold hears_in_window; rewrite Own, P. cbn [wfr_step]. cbn [epochs REPAIRED negb]; rewrite orb_false_r, M.
          unfold hears_move; rewrite P; cbn [window REPAIRED fst mid].
          set (b := {| mhc := h; mid := r |}) in *.
          assert (is_best match best with Some first => better REPAIRED first b | None => b end (l ++ [b])) as Best.
          { destruct best as [first|].
            - apply best_of_more; now apply (best_so_far _ _ _ V).
            - rewrite (nobody_yet _ _ _ V P); apply best_of_one. }
          unfold remembers. destruct (existsb (Nat.eqb r) (asked x)) eqn:X; cbn [orb].
          - assert (In r (asked x)) as R.
            { apply existsb_exists in X; destruct X as [s [S E]]; apply Nat.eqb_eq in E; now subst. }
            constructor; cbn; try discriminate; try (intros ? [= <-]; exact Best); try apply V.
            + intros s S; rewrite map_app; apply in_or_app; left; now apply (asked_heard _ _ _ V).
            + intros d D; apply in_app_or in D; destruct D as [D|[<-|[]]]; [now apply (heard_asked _ _ _ V) | auto].
          - assert (~ In r (asked x)) as R.
            { intros R; assert (existsb (Nat.eqb r) (asked x) = true); [|congruence].
              apply existsb_exists; exists r; split; [exact R | apply Nat.eqb_refl]. }
            destruct (Nat.leb_spec room (length (asked x))) as [Full|Full].
            + constructor; cbn; try discriminate; try (intros ? [= <-]; exact Best); try apply V.
              * intros s S; rewrite map_app; apply in_or_app; left; now apply (asked_heard _ _ _ V).
              * auto.
            + constructor; cbn; try discriminate; try (intros ? [= <-]; exact Best).
              * apply (NoDup_Add (a := r) (l := asked x)); [rewrite <- (app_nil_r (asked x)) at 1;
                  apply Add_app | split; [apply V | exact R]].
              * intros s S; rewrite map_app; apply in_or_app; apply in_app_or in S. cbn.
                destruct S as [S|[<-|[]]]; [left; now apply (asked_heard _ _ _ V) | auto].
              * intros d D; left; apply in_or_app; apply in_app_or in D; destruct D as [D|[<-|[]]]; [left | right;
                  now left].
                destruct (heard_asked _ _ _ V d D); [assumption | lia]. }
      all: rewrite Shut by (right; congruence); cbn [wfr_step]; cbn [epochs REPAIRED negb]; rewrite orb_false_r, M;
        unfold hears_move; rewrite P; exact V.
    + rewrite Shut by (left; cbn; now rewrite M). cbn [wfr_step]; cbn [epochs REPAIRED negb];
        now rewrite orb_false_r, M.
  - rewrite Shut by (left; reflexivity). cbn [wfr_step]. destruct (_ && _); [|exact V].
    destruct (stage x) as [|best|c k|c|] eqn:P; try exact V. destruct (mid c =? r); [|exact V].
    apply inv_at; try discriminate; auto. intros d; cbn; intros [= <-]. apply (choice_best _ _ _ V); unfold choice_of;
      now rewrite P.
  - rewrite Shut by (left; reflexivity). cbn [wfr_step]. destruct (_ && _); [|exact V].
    destruct (stage x) as [|best|c k|c|] eqn:P; try exact V. destruct (_ && _); [apply New | exact V].
  - rewrite Shut by (left; reflexivity). cbn [wfr_step]; cbn [window renewal REPAIRED andb].
    destruct (stage x) as [|[b|]|c [|k]|c|] eqn:P; try exact V; try apply New.
    + cbn [chooses consent REPAIRED fst snd].
      replace (existsb _ (tells_all x b)) with false by (symmetry; unfold tells_all; now induction (asked x)).
      apply inv_at; try discriminate; auto. intros d; cbn; intros [= <-]; now apply (best_so_far _ _ _ V).
    + cbn. apply inv_at; try discriminate; auto. intros d; cbn; intros [= <-].
      apply (choice_best _ _ _ V); unfold choice_of; now rewrite P.
  - rewrite Shut by (left; reflexivity). cbn [wfr_step].
    destruct (stage x) eqn:P; cbn; try exact V; apply inv_at; try discriminate; auto.
Qed.

Lemma inv_always : forall me room ins,
  inv room (wfr_after REPAIRED me room ins) (in_window REPAIRED me room ins).
Proof.
  intros me room ins; induction ins as [|i ins IH] using rev_ind.
  - constructor; cbn; try discriminate; try contradiction; auto; constructor.
  - rewrite in_window_snoc. unfold wfr_after; rewrite after_snoc. now apply inv_step.
Qed.

(** ** The clauses *)

(** Whom a WFR has chosen is the best of the MOVEs that it had received when its window closed. *)
Theorem MRC_3 : forall me room ins c,
  choice_of (wfr_after REPAIRED me room ins) = Some c -> is_best c (in_window REPAIRED me room ins).
Proof. intros me room ins c; apply (choice_best _ _ _ (inv_always me room ins)). Qed.

(** A WFR that has room for all who have asked tells its choice to each whose MOVE it received in its window; a MOVE
    that comes later it answers, with the choice or, rescued, with nobody's name. Of a call it tells only that, and
    to no other. *)
Theorem MRC_9 : forall me room ins, let x := wfr_after REPAIRED me room ins in
  let l := in_window REPAIRED me room ins in
  at_most room (fun r => In r (map mid l)) ->
  forall i y out, wfr_step REPAIRED me room x i = (y, out) ->
  (forall c b, choice_of x = None -> choice_of y = Some c -> In b l -> In (Resb (call x) (mid b) (Some (mid c))) out)
  /\ (forall b, own_move me x i = Some b -> choice_of x <> None \/ stage x = Rescued ->
      out = [Resb (call x) (mid b) (option_map mid (choice_of x))])
  /\ (forall e r c, In (Resb e r c) out -> e = call x /\ c = option_map mid (choice_of y)
      /\ (In r (map mid l) \/ exists b, own_move me x i = Some b /\ mid b = r)).
Proof.
  intros me room ins x l Room i y out H; pose proof (inv_always me room ins : inv room x l) as V; clearbody x l.
  assert (forall b, In b l -> In (mid b) (asked x)) as All.
  { intros b B; destruct (heard_asked _ _ _ V b B) as [A|Full]; [exact A|].
    destruct (in_dec Nat.eq_dec (mid b) (asked x)) as [A|A]; [exact A | exfalso].
    assert (length (mid b :: asked x) <= room); [|cbn in *; lia].
    apply Room; [constructor; [exact A | apply V]|]. intros r [<-|R];
      [now apply in_map | now apply (asked_heard _ _ _ V)]. }
  (* where nothing is told and nobody is chosen *)
  assert (choice_of y = choice_of x \/ choice_of y = None -> own_move me x i = None ->
    (forall e r c, ~ In (Resb e r c) out) ->
    (forall c b, choice_of x = None -> choice_of y = Some c -> In b l -> In (Resb (call x) (mid b) (Some (mid c))) out)
    /\ (forall b, own_move me x i = Some b -> choice_of x <> None \/ stage x = Rescued ->
        out = [Resb (call x) (mid b) (option_map mid (choice_of x))])
    /\ (forall e r c, In (Resb e r c) out -> e = call x /\ c = option_map mid (choice_of y)
        /\ (In r (map mid l) \/ exists b, own_move me x i = Some b /\ mid b = r))) as Quiet.
  { intros [C|C] O Q; rewrite O, C; (split; [|split]); try (intros; congruence); intros e r c I; now apply Q in I. }
  destruct i as [|w e r says| |]; cbn [wfr_step] in H; cbn [window renewal epochs REPAIRED andb negb] in H;
    rewrite ?orb_false_r in H.
  - apply Quiet; [|reflexivity|]; unfold choice_of; destruct (stage x) eqn:P; injection H as <- <-; cbn; rewrite ?P;
      auto;
      try (intros ? ? ? [[=]|[]]).
  - destruct ((w =? me) && (e =? call x)) eqn:M.
    2:{ injection H as <- <-; apply Quiet; cbn; [auto | destruct says; rewrite ?M; reflexivity | auto]. }
    destruct says as [h| |].
    + cbn [own_move]; rewrite M. unfold hears_move in H. cbn [window choice_stands REPAIRED mid] in H.
      unfold answers in H; cbn [answers_again REPAIRED] in H.
      unfold choice_of; destruct (stage x) as [|best|c k|c|] eqn:P; injection H as <- <-; cbn; rewrite ?P; cbn;
        (split; [intros; discriminate|]); (split; [intros b [= <-] [C|C]; reflexivity || congruence|]);
        intros e' r' c' I; try contradiction; destruct I as [[= <- <- <-]|[]]; eauto 6.
    + apply Quiet; [|reflexivity|]; unfold choice_of; destruct (stage x) as [|best|c k|c|] eqn:P;
        try destruct (mid c =? r); injection H as <- <-; cbn; rewrite ?P; auto.
    + apply Quiet; [|reflexivity|]; unfold choice_of; destruct (stage x) as [|best|c k|c|] eqn:P;
        try destruct (mid c =? r); injection H as <- <-; cbn; rewrite ?P; auto; intros ? ? ? [[=]|[]].
  - destruct (stage x) as [|[b|]|c [|k]|c|] eqn:P; injection H as <- <-;
      try solve [apply Quiet; [|reflexivity|]; unfold choice_of; cbn; rewrite ?P; auto; intros ? ? ? [[=]|[]]].
    + unfold choice_of; cbn; rewrite P; split; [|split]; [|discriminate|].
      * intros c d _ [= <-] D; apply in_map_iff; exists (mid d); split; [reflexivity | now apply All].
      * intros e r c I; apply in_map_iff in I; destruct I as [a [[= <- <- <-] A]].
        repeat split; left; now apply (asked_heard _ _ _ V).
    + unfold choice_of; cbn; rewrite P; split; [|split]; [discriminate | discriminate|].
      intros e r d [[= <- <- <-]|[]]. repeat split; left; apply in_map.
      apply (choice_best _ _ _ V); unfold choice_of; now rewrite P.
  - apply Quiet; [|reflexivity|]; unfold choice_of; destruct (stage x) eqn:P; injection H as <- <-; cbn; rewrite ?P;
      auto.
Qed.

(** ** What each condition is needed for *)

(** WFR 1 hears MOVEs with these hop counts of robots 1, 2, …, its window closes, and it hears more. *)
Definition window_of (l : list (nat * nat)) (later : list wfr_input) : list wfr_input :=
  Raised :: map (fun m => Says 1 1 (fst m) (Move (snd m))) l ++ Expires :: later.

Theorem each_condition_is_needed_for_MRC_3 :
  Forall (fun case => exists c, choice_of (wfr_after (fst case) 1 9 (snd case)) = Some c
                        /\ ~ is_best c (in_window (fst case) 1 9 (snd case)))
    [(without_NearestRobot, window_of [(1, 5); (2, 4)] []);
     (without_LeastIdentity, window_of [(2, 4); (1, 4)] []);
     (without_ChoiceStands, window_of [(2, 4)] [Says 1 1 1 (Move 3)]);
     (without_Epochs, [Raised; Says 1 7 2 (Move 4); Expires])].
Proof.
  repeat constructor; cbn [fst snd].
  all: eexists; split; [vm_compute; reflexivity|]; intros [I B]; vm_compute in I.
  - specialize (B {| mhc := 4; mid := 2 |} ltac:(vm_compute; auto)); cbn in B; lia.
  - specialize (B {| mhc := 4; mid := 1 |} ltac:(vm_compute; auto)); cbn in B; lia.
  - destruct I as [[=]|[]].
  - destruct I.
Qed.

(** Without AnswersAgain a MOVE that comes late is not answered. A WFR that has no room for all tells its choice not
    to all. *)
Theorem without_AnswersAgain_breaks_MRC_9 : exists ins, let x := wfr_after without_AnswersAgain 1 9 ins in
  let late := Says 1 1 2 (Move 4) in
  choice_of x <> None /\ own_move 1 x late <> None /\ snd (wfr_step without_AnswersAgain 1 9 x late) = [].
Proof. exists (window_of [(1, 4)] []); repeat split; vm_compute; congruence. Qed.

Theorem without_room_breaks_MRC_9 : exists ins, let x := wfr_after REPAIRED 1 1 ins in
  In 2 (map mid (in_window REPAIRED 1 1 ins))
  /\ snd (wfr_step REPAIRED 1 1 x Expires) = [Resb 1 1 (Some 1)].
Proof. exists [Raised; Says 1 1 1 (Move 4); Says 1 1 2 (Move 4)]; split; vm_compute; auto. Qed.
