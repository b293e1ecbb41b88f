(** Whatever a robot and a WFR of Machines.v do, repaired, those of Mrc.v may do: so what Leases.v says of every network
    of the latter holds of the former, whatever hop counts, parents and room they have. *)
From Coq Require Import List Bool Arith Lia.
From Tautline Require Import Machines Robots.
From Tautline Require Mrc.
Import ListNotations.

(** ** Without hop counts, parents and repeats *)

Definition plain_request (q : request) : Mrc.request :=
  {| Mrc.wfr_of := about q; Mrc.epoch := epoch q; Mrc.served := served q |}.
Definition plain_task (t : task) : Mrc.task :=
  match t with Free => Mrc.Free | Asking w e _ => Mrc.Asking w e | Leased w e => Mrc.Leased w e end.
Definition plain_robot (x : robot) : Mrc.robot :=
  {| Mrc.requests := map plain_request (requests x); Mrc.doing := plain_task (doing x) |}.
Definition plain_robot_input (i : robot_input) : Mrc.robot_input :=
  match i with
  | Notice w e _ _ => Mrc.Told (Mrc.Notice w e)
  | Tells w e to c => Mrc.Told (Mrc.Resb w e to c)
  | Waited => Mrc.Waited
  | Arrives => Mrc.Arrives
  | Lapses w e => Mrc.Lapses w e
  end.
Definition plain_upward (r : nat) (m : upward) : Mrc.message :=
  match says m with
  | Move _ => Mrc.Move (to_wfr m) (of_call m) r
  | Accept => Mrc.Accept (to_wfr m) (of_call m) r
  | Decline => Mrc.Decline (to_wfr m) (of_call m) r
  end.
Definition plain_said (r : nat) (m : option upward) : list Mrc.message :=
  match m with Some m => [plain_upward r m] | None => [] end.

Lemma plain_record : forall x w, Mrc.record_of (plain_robot x) w = option_map plain_request (record_of x w).
Proof.
  intros x w; unfold Mrc.record_of, record_of, plain_robot; cbn [Mrc.requests]. induction (requests x) as [|q l IH];
    [reflexivity|].
  cbn [map find]; unfold Mrc.about, is_about in *; cbn [plain_request Mrc.wfr_of]. now destruct (about q =? w).
Qed.

Lemma plain_serve : forall w l t, plain_robot {| requests := serve w l; doing := t |} =
  Mrc.now (Mrc.serve w (plain_robot {| requests := l; doing := t |})) (plain_task t).
Proof.
  intros w l t; unfold plain_robot, Mrc.serve, Mrc.now, serve, change, Mrc.change; cbn. f_equal.
  rewrite !map_map; apply map_ext; intros q; unfold is_about, Mrc.about; cbn. now destruct (about q =? w).
Qed.

Lemma plain_asks : forall rl me z, NoDup (map about (requests z)) ->
  In (plain_robot (fst (asks rl z)), plain_said me (snd (asks rl z))) (Mrc.asks me (plain_robot z)).
Proof.
  intros rl me z N; unfold asks. destruct (doing z) as [|v f k|v f] eqn:D; [|now left|now left].
  destruct (nearest rl (requests z)) as [q|] eqn:Q; [|now left]. right.
  apply nearest_in in Q; destruct Q as [I S]. unfold plain_robot at 2; cbn [Mrc.doing]. rewrite D;
    cbn [plain_task Mrc.doing].
  apply in_flat_map; exists (plain_request q); split; [now apply in_map|]. cbn [plain_request Mrc.wfr_of].
  rewrite plain_record. unfold record_of; rewrite (one_record _ _ N I); cbn [option_map plain_request Mrc.served].
  rewrite S; left. reflexivity.
Qed.

Lemma plain_adds : forall room x q, In (plain_robot {| requests := adds room x q; doing := doing x |})
  (Mrc.adds (plain_robot x) (plain_request q)).
Proof.
  intros room x q; unfold Mrc.adds; apply in_map_iff; exists (map plain_request (adds room x q)); split; [reflexivity|].
  cbn [plain_robot Mrc.requests Mrc.doing]. unfold adds; destruct (_ <? _); [right; left; now rewrite map_app|].
  assert (forall w, Mrc.is_own (plain_task (doing x)) w = is_own (doing x) w) as Own by (intros;
    now destruct (doing x)).
  induction (requests x) as [|p l IH]; [left; reflexivity|]. cbn [gives_way].
  destruct (served p && negb (is_own (doing x) (about p))) eqn:E.
  - right; right; cbn [map Mrc.making_room]; apply in_or_app; left. cbn [plain_request Mrc.served Mrc.wfr_of].
    rewrite Own, E; now left.
  - cbn [map]. destruct IH as [IH|[IH|IH]].
    + left; now rewrite <- IH.
    + exfalso. assert (forall l', length (gives_way (is_own (doing x)) q l') = length l') as Len.
      { induction l' as [|p' l' Ih]; [reflexivity|]. cbn [gives_way]; destruct (served p' && _); cbn [length];
          [reflexivity | now rewrite Ih]. }
      apply (f_equal (@length _)) in IH; rewrite app_length, !map_length, Len in IH; cbn in IH; lia.
    + right; right; cbn [Mrc.making_room]; apply in_or_app; right. now apply in_map.
Qed.

Lemma one_of : forall l p q, NoDup (map about l) -> In p l -> find (is_about (about p)) l = Some q -> p = q.
Proof. intros l p q N I F; rewrite (one_record l p N I) in F; congruence. Qed.

(** What a robot of Machines.v does, one of Mrc.v may do. *)
Theorem robots_are_refined : forall me room ins i y m,
  robot_step REPAIRED me room (robot_after REPAIRED me room ins) i = (y, m) ->
  In (plain_robot y, plain_said me m)
    (Mrc.robot_outcomes Mrc.REPAIRED me (plain_robot (robot_after REPAIRED me room ins)) (plain_robot_input i)).
Proof.
  intros me room ins i y m; pose proof (inv_always REPAIRED me room ins) as V.
  set (x := robot_after REPAIRED me room ins) in *; clearbody x; intros H.
  assert (forall z, asks REPAIRED z = (y, m) -> NoDup (map about (requests z)) ->
    In (plain_robot y, plain_said me m) (Mrc.asks me (plain_robot z))) as A.
  { intros z E N. pose proof (plain_asks REPAIRED me z N) as P. now rewrite E in P. }
  assert ((x, None) = (y, m) -> In (plain_robot y, plain_said me m) [(plain_robot x, [])]) as Same.
  { intros [= <- <-]; now left. }
  assert (forall w, NoDup (map about (serve w (requests x)))) as Once by (intros; rewrite serve_about; apply V).
  destruct i as [w e h s|w e to c| | |w e]; cbn [robot_step plain_robot_input Mrc.robot_outcomes] in *.
  - apply in_flat_map; exists (plain_robot (notes REPAIRED room x
      {| about := w; epoch := e; served := false; hops := S h; parent := s |})).
    split; [|apply (A _ H); now apply notes_once, V].
    unfold notes; cbn [about]. unfold Mrc.notes; rewrite plain_record.
    destruct (record_of x w) as [q|] eqn:R; cbn [option_map]; [|apply plain_adds].
    assert (forall p, In p (requests x) -> is_about w p = true -> p = q) as Only.
    { intros p I P; unfold is_about in P; apply Nat.eqb_eq in P. apply (one_of (requests x)); [apply V | exact I|].
      rewrite P; exact R. }
    cbn [Mrc.epochs Mrc.REPAIRED plain_request Mrc.epoch epochs REPAIRED andb epoch].
    destruct (Nat.ltb_spec (epoch q) e) as [L|L]; left; unfold plain_robot, Mrc.change, change;
      cbn [Mrc.requests Mrc.doing requests doing]; f_equal.
    + rewrite !map_map; apply map_ext_in; intros p I; specialize (Only p I); unfold is_about, Mrc.about in *;
        cbn [plain_request Mrc.wfr_of]. destruct (about p =? w) eqn:P; [|reflexivity]. rewrite (Only eq_refl).
      unfold noted; cbn [epochs REPAIRED andb epoch]. apply Nat.ltb_lt in L; now rewrite L.
    + destruct (doing x); cbn; try reflexivity; now destruct (_ =? w).
    + rewrite map_map; apply map_ext_in; intros p I; specialize (Only p I).
      destruct (is_about w p) eqn:P; [|reflexivity]. rewrite (Only eq_refl).
      unfold noted; cbn [epochs REPAIRED andb epoch]. apply Nat.ltb_ge in L; rewrite L.
      destruct (Nat.eqb_spec (epoch q) e) as [<-|D]; [|reflexivity]. unfold plain_request; cbn. now rewrite Nat.max_id.
  - destruct (to =? me); [|now apply Same]. unfold heeds in H; unfold Mrc.heeds; rewrite plain_record.
    destruct (record_of x w) as [q|]; cbn [option_map]; [|now apply Same].
    cbn [Mrc.epochs Mrc.REPAIRED Mrc.consent plain_request Mrc.epoch epochs consent still_asks REPAIRED andb negb] in *.
    destruct (Nat.eqb_spec (epoch q) e) as [E|E]; cbn [negb] in *; [|now apply Same].
    assert (plain_robot {| requests := serve w (requests x); doing := doing x |} = Mrc.serve w (plain_robot x)) as
      Serve.
    { rewrite plain_serve; unfold Mrc.now, Mrc.serve, plain_robot; reflexivity. }
    assert (forall t, plain_robot {| requests := serve w (requests x); doing := t |}
      = Mrc.now (Mrc.serve w (plain_robot x)) (plain_task t)) as Now by (intros; rewrite plain_serve; reflexivity).
    cbn [plain_robot Mrc.doing] in *.
    destruct (match c with Some c => c =? me | None => false end).
    + injection H as <- <-. rewrite ?andb_false_r, ?orb_false_r. left. unfold plain_said, plain_upward;
        cbn [says to_wfr of_call].
      destruct (doing x) as [|v f k|v f] eqn:D; cbn [plain_task]; rewrite ?andb_false_r, ?orb_false_r; cbn [orb];
        try destruct (v =? w); cbn [orb]; rewrite ?Now, <- ?Serve; reflexivity.
    + rewrite ?andb_false_r, ?orb_false_r in *.
      assert (forall z, asks REPAIRED z = (y, m) -> requests z = serve w (requests x) ->
        In (plain_robot y, plain_said me m) (Mrc.asks me (plain_robot z))) as B.
      { intros z Z F; apply (A z Z); rewrite F; apply Once. }
      specialize (B _ H eq_refl).
      destruct (doing x) as [|v f k|v f]; cbn [plain_task orb] in *; try destruct (v =? w); rewrite ?andb_false_r in *;
        first [rewrite <- Serve; exact B | rewrite Now in B; exact B].
  - cbn [plain_robot Mrc.doing]. destruct (doing x) as [|w e [|k]|w e] eqn:D; cbn [plain_task repetition REPAIRED] in *;
      try (now apply Same).
    + right. specialize (A _ H (Once w)). rewrite plain_serve in A. exact A.
    + left. destruct (asks_open _ _ V _ _ _ D) as [q [Q [_ E]]]. rewrite Q in H; injection H as <- <-.
      cbn [option_map plain_said bids plain_upward says to_wfr of_call]. rewrite (E eq_refl).
      apply record_in in Q; destruct Q as [_ ->]. unfold plain_robot; cbn; rewrite D; reflexivity.
  - cbn [plain_robot Mrc.doing]. destruct (doing x) eqn:D; cbn [plain_task] in *; apply A in H; try apply V; exact H.
  - cbn [plain_robot Mrc.doing]. destruct (doing x) as [|v f k|v f] eqn:D; cbn [plain_task] in *; try (now apply Same).
    destruct (_ && _); [|now apply Same]. apply A in H; [exact H | apply V].
Qed.

(** ** A WFR *)

Definition plain_phase (p : phase) : Mrc.phase :=
  match p with
  | Idle => Mrc.Idle
  | Collecting best => Mrc.Collecting (option_map mid best)
  | Offered c _ => Mrc.Offered (mid c)
  | CountsOn c => Mrc.CountsOn (mid c)
  | Rescued => Mrc.Rescued
  end.
Definition plain_wfr (x : wfr) : Mrc.wfr :=
  {| Mrc.call := call x; Mrc.stage := plain_phase (stage x); Mrc.asked := asked x |}.
Definition plain_wfr_input (i : wfr_input) : Mrc.wfr_input :=
  match i with
  | Raised => Mrc.Raised
  | Says w e r (Move _) => Mrc.Hears (Mrc.Move w e r)
  | Says w e r Accept => Mrc.Hears (Mrc.Accept w e r)
  | Says w e r Decline => Mrc.Hears (Mrc.Decline w e r)
  | Expires => Mrc.Expires
  | Reached => Mrc.Reached
  end.
Definition plain_mail (me : nat) (m : mail) : Mrc.message :=
  match m with Calls e => Mrc.Notice me e | Resb e to c => Mrc.Resb me e to c end.

(** What a WFR of Machines.v does, one of Mrc.v may do. *)
Theorem wfrs_are_refined : forall me room x i y out, wfr_step REPAIRED me room x i = (y, out) ->
  In (plain_wfr y, map (plain_mail me) out) (Mrc.wfr_outcomes Mrc.REPAIRED me (plain_wfr x) (plain_wfr_input i)).
Proof.
  intros me room x i y out H.
  assert ((x, []) = (y, out) -> In (plain_wfr y, map (plain_mail me) out) [(plain_wfr x, [])]) as Same
    by (intros [= <- <-]; now left).
  destruct i as [|w e r says| |]; cbn [wfr_step plain_wfr_input] in *;
    cbn [window renewal epochs REPAIRED andb negb] in H.
  - cbn [Mrc.wfr_outcomes plain_wfr Mrc.stage]. destruct (stage x) eqn:P; cbn [plain_phase]; try (now apply Same);
      injection H as <- <-; left; reflexivity.
  - rewrite orb_false_r in H.
    assert (forall b, b && (negb (Mrc.epochs Mrc.REPAIRED) || (e =? call x)) = b && (e =? call x)) as Mine by
      reflexivity.
    destruct says as [h| |]; cbn [Mrc.wfr_outcomes]; cbn [plain_wfr Mrc.call Mrc.stage]; rewrite Mine;
      destruct ((w =? me) && (e =? call x)) eqn:M; try (now apply Same);
      try (destruct (stage x); cbn [plain_phase andb]; now apply Same).
    + unfold hears_move in H; unfold Mrc.hears_move; cbn [plain_wfr Mrc.stage Mrc.choice_stands Mrc.REPAIRED].
      cbn [window choice_stands REPAIRED mid] in H. unfold answers in H; cbn [answers_again REPAIRED] in H.
      destruct (stage x) as [|best|c k|c|] eqn:P; cbn [plain_phase]; try (now apply Same);
        try (injection H as <- <-; left; reflexivity).
      injection H as <- <-. apply in_flat_map; exists (asked (remembers room x r)); split.
      * unfold remembers, Mrc.remembered; cbn [plain_wfr Mrc.asked]. destruct (existsb _ (asked x)); cbn [orb];
          [now left|].
        destruct (room <=? _); [right; now left | now left].
      * apply in_map_iff. exists (mid match best with Some first => better REPAIRED first {| mhc := h; mid := r |}
                                     | None => {| mhc := h; mid := r |} end); split.
        -- assert (call (remembers room x r) = call x) as C by (unfold remembers;
             destruct (existsb (Nat.eqb r) (asked x) || (room <=? length (asked x))); reflexivity).
           unfold plain_wfr, at_phase; cbn [call stage asked Mrc.call plain_phase option_map map mid]. rewrite C. now
             destruct best.
        -- destruct best as [b|]; cbn; [|now left]. unfold better; destruct (is_better _ _ _); cbn; auto.
    + destruct (stage x) as [|best|c k|c|] eqn:P; cbn [plain_phase andb]; try (now apply Same).
      destruct (mid c =? r); [|now apply Same]. injection H as <- <-; left; reflexivity.
    + destruct (stage x) as [|best|c k|c|] eqn:P; cbn [plain_phase andb]; try (now apply Same).
      rewrite andb_true_r in H. destruct (mid c =? r); [|now apply Same]. injection H as <- <-; left; reflexivity.
  - cbn [Mrc.wfr_outcomes plain_wfr Mrc.stage]. destruct (stage x) as [|[b|]|c [|k]|c|] eqn:P;
      cbn [plain_phase option_map];
      try (now apply Same); injection H as <- <-; try (left; reflexivity); try (right; left; reflexivity);
      [|left; unfold plain_wfr; cbn; now rewrite P].
    left; unfold Mrc.choose, Mrc.tell_all, chooses, tells_all, plain_wfr, at_phase; cbn. now rewrite map_map.
  - cbn [Mrc.wfr_outcomes plain_wfr Mrc.stage]. destruct (stage x) eqn:P; cbn [plain_phase]; try (now apply Same);
      injection H as <- <-; left; reflexivity.
Qed.
