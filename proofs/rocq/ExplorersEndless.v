(** The condition Keep is needed for FRONTIER-3 where messages are missed: four robots of the kernel, of which two miss what
    the other two find, have a run without an end without it. Each of the two waits for the other one to make way. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Explorers ExplorersEnd ExplorersTie.
From Tautline.generated Require Import FrontierEndless.
Import ListNotations.

(** ** Worlds that differ in nothing that a robot decides by. *)
Section Like.
  Variables (V : Type) (same : V -> V -> bool) (obstacle : V -> bool) (N : nat) (rl : rule V).

  Definition like_robot (r r' : robot V) : Prop :=
    explored r = explored r' /\ blocked r = blocked r' /\ place r = place r' /\ doing r = doing r' /\ aim r = aim r'
    /\ waits r = waits r' /\ news r = news r' /\ forall j, j < N -> told r j = told r' j.
  Definition like_robots (f f' : nat -> robot V) : Prop := forall i, i < N -> like_robot (f i) (f' i).
  Definition like (w w' : world V) : Prop :=
    like_robots (robots w) (robots w') /\ slot w = slot w' /\ old w = old w' /\ tried w = tried w'.
  Hypothesis rl_like : forall i r r', like_robot r r' -> chooses rl i r = chooses rl i r'.

  Lemma some_like : forall f g, (forall i, i < N -> f i = g i) -> some N f = some N g.
  Proof.
    intros f g H; apply eq_true_iff_eq; rewrite !some_spec; split; intros [i [I E]]; exists i; split; auto;
      [rewrite <- H | rewrite H]; auto.
  Qed.
  Lemma would_like : forall w w' i, like w w' -> i < N -> would V rl w i = would V rl w' i.
  Proof. intros w w' i [L _] I; unfold would; now rewrite (rl_like i _ _ (L i I)). Qed.
  Lemma moves_like : forall w w' i, like w w' -> i < N -> moves V w i = moves V w' i.
  Proof. intros w w' i [L _] I; destruct (L i I) as [_ [_ [_ [D _]]]]; unfold moves; now rewrite D. Qed.
  Lemma waiting_like : forall w w' i, like w w' -> i < N -> waiting V rl w i = waiting V rl w' i.
  Proof.
    intros w w' i L I; unfold waiting; rewrite (would_like w w' i L I); destruct L as [L _].
    destruct (L i I) as [_ [_ [_ [_ [_ [-> _]]]]]]; reflexivity.
  Qed.
  Lemma may_decide_like : forall w w' i, like w w' -> i < N -> may_decide V rl w i = may_decide V rl w' i.
  Proof.
    intros w w' i L I; unfold may_decide; rewrite (would_like w w' i L I), (moves_like w w' i L I).
    destruct L as [L [-> [_ ->]]]; destruct (L i I) as [_ [_ [_ [_ [_ [-> _]]]]]]; reflexivity.
  Qed.
  Lemma may_tick_like : forall w w', like w w' -> slot w < N -> may_tick V N rl w = may_tick V N rl w'.
  Proof.
    intros w w' L I; unfold may_tick; rewrite (waiting_like w w' _ L I).
    rewrite (some_like (waiting V rl w) (waiting V rl w')) by (intros; now apply waiting_like).
    pose proof L as [_ [S [O T]]]; rewrite <- S, <- T; f_equal; f_equal; apply some_like; intros i J.
    now rewrite (moves_like w w' i L J), S, O.
  Qed.
  Lemma meets_like : forall w w' i v, like w w' -> meets V same N w i v = meets V same N w' i v.
  Proof.
    intros w w' i v [L _]; unfold meets; apply filter_ext_in; intros j J; apply in_seq in J.
    destruct (L j ltac:(lia)) as [_ [_ [-> [-> _]]]]; reflexivity.
  Qed.
  Lemma hears_like : forall r r' j s s', like_robot r r' -> like_robot s s' ->
    like_robot (hears V same r j s) (hears V same r' j s').
  Proof.
    intros r r' j s s' [A [B [C [D [E [F [Nw G]]]]]]] [A' [B' [C' [_ [E' _]]]]]; repeat split; cbn; try congruence.
    intros k K; unfold put; destruct (k =? j); [congruence | auto].
  Qed.
  Lemma put_like : forall f f' i r r', like_robots f f' -> like_robot r r' -> like_robots (put f i r) (put f' i r').
  Proof. intros f f' i r r' L R j J; unfold put; destruct (j =? i); auto. Qed.
  Lemma tells_like : forall f f' i ms, like_robots f f' -> i < N -> like_robots (tells V same f i ms) (tells V same f' i ms).
  Proof. intros f f' i ms L I j J; unfold tells; destruct (_ || _); [auto | apply hears_like; auto]. Qed.
  Lemma told_like : forall f f' i l, like_robots f f' -> i < N -> (forall j, In j l -> j < N) ->
    like_robots (is_told V same f i l) (is_told V same f' i l).
  Proof.
    intros f f' i l L I J; apply put_like; [exact L|]. specialize (L i I) as R; revert R; generalize (f i), (f' i).
    induction l as [|k l IH]; intros r r' R; cbn; [exact R|]. apply IH; [intros; apply J; now right|].
    apply hears_like; [exact R | apply L, J; now left].
  Qed.
  Lemma settle_like : forall w w', like w w' -> like (settle V N rl w) (settle V N rl w').
  Proof.
    intros w w' L; unfold settle; rewrite (some_like (waiting V rl w) (waiting V rl w')) by (intros; now apply waiting_like).
    destruct (some _ _); [exact L | split; [exact (proj1 L) | auto]].
  Qed.
  Lemma become_like : forall r r' d a b, like_robot r r' -> like_robot (becomes V r d a b) (becomes V r' d a b).
  Proof. intros r r' d a b [A [B [C [D [E [F [Nw G]]]]]]]; repeat split; auto; cbn; now rewrite Nw. Qed.

  (** The same event leads both to worlds that are alike so. *)
  Lemma next_like : forall w w' e x, like w w' -> slot w < N -> next V same obstacle N rl w e = Some x ->
    exists x', next V same obstacle N rl w' e = Some x' /\ like x x'.
  Proof.
    intros w w' e x L Sl E; pose proof L as [R [S [O T]]].
    destruct e as [i v c ms | i ms un s | i ms |]; cbn [next] in *.
    - destruct (i <? N) eqn:I; [apply Nat.ltb_lt in I | discriminate]; rewrite <- (may_decide_like w w' i L I), <- (rl_like i _ _ (R i I)).
      destruct (_ && _); [|discriminate]; injection E as <-; eexists; split; [reflexivity|].
      destruct (R i I) as [_ [_ [_ [_ [_ [<- _]]]]]]; split; [|auto]; cbn.
      destruct (claims rl); [apply tells_like; [|exact I]|]; (apply put_like; [exact R | apply become_like, R, I]).
    - destruct (i <? N) eqn:I; [apply Nat.ltb_lt in I | destruct (doing (robots w i)); discriminate].
      destruct (R i I) as [A [B [C [D [F [W [Nw To]]]]]]]; rewrite <- D. destruct (doing (robots w i)) as [|v|v]; try discriminate.
      destruct (negb _); [discriminate|]; rewrite <- (meets_like w w' i v L). destruct (meets V same N w i v) as [|k met] eqn:M.
      + injection E as <-; eexists; split; [reflexivity|]; apply settle_like; split; [|auto]; cbn [robots with_robots].
        assert (late V same rl (robots w' i) v = late V same rl (robots w i) v) as La by (unfold late; now rewrite A, F).
        rewrite La, <- F; set (r := if obstacle v then blocks _ _ (robots w i) _ else _); set (r' := if obstacle v then blocks _ _ (robots w' i) _ else _).
        assert (like_robots (put (robots w) i r) (put (robots w') i r')) as P.
        { apply put_like; [exact R|]; subst r r'; destruct (obstacle v); [|destruct (late V same rl (robots w i) v); [|apply become_like, R, I]];
            repeat split; cbn [explored blocked place doing aim waits news told blocks turns];
            rewrite ?A, ?B, ?Nw; auto. }
        destruct (obstacle v); [now apply tells_like | exact P].
      + injection E as <-; eexists; split; [reflexivity|].
        rewrite <- (some_like (waiting V rl w) (waiting V rl w')) by (intros; now apply waiting_like).
        rewrite <- S, <- O, <- T; apply settle_like; split; [|auto]; cbn [robots].
        apply told_like; [|exact I | intros j J; apply filter_In in J; destruct J as [J _]; rewrite <- M in J; now apply meets_robots in J].
        apply tells_like, I; (apply put_like; [exact R | apply become_like, R, I]).
    - destruct (i <? N) eqn:I; [apply Nat.ltb_lt in I | destruct (doing (robots w i)); discriminate].
      destruct (R i I) as [A [B [C [D [F [W [Nw To]]]]]]]; rewrite <- D. destruct (doing (robots w i)) as [|v|v]; try discriminate.
      injection E as <-; eexists; split; [reflexivity|]; apply settle_like; split; [|auto]; cbn.
      apply tells_like, I; apply put_like; [exact R|]; unfold lands; repeat split;
        cbn [explored blocked place doing aim waits news told]; rewrite ?A, ?B, ?C, ?F, ?Nw; auto.
    - rewrite <- (may_tick_like w w' L Sl); destruct (may_tick _ _ _ _); [|discriminate]; injection E as <-.
      eexists; split; [reflexivity|]; split; [exact R|]; cbn; rewrite <- S; repeat split; auto.
      apply filter_ext_in; intros j J; apply in_seq in J; apply moves_like; [exact L | lia].
  Qed.
  Lemma like_sym : forall w w', like w w' -> like w' w.
  Proof.
    intros w w' [R [S [O T]]]; repeat split; auto; destruct (R i H) as [A [B [C [D [E [F [Nw G]]]]]]]; auto. intros j J; symmetry; auto.
  Qed.
  Lemma like_trans : forall w x y, like w x -> like x y -> like w y.
  Proof.
    intros w x y [R [S [O T]]] [R' [S' [O' T']]]; split; [|repeat split; congruence]; intros i I.
    destruct (R i I) as [A [B [C [D [E [F [Nw G]]]]]]], (R' i I) as [A' [B' [C' [D' [E' [F' [Nw' G']]]]]]]; repeat split; try congruence.
    intros j J; rewrite G, G'; auto.
  Qed.
End Like.

Lemma paired_like : forall V same cells beside N number rim k i r r', like_robot V N r r' ->
  chooses (PAIRED V same cells beside N number rim k) i r = chooses (PAIRED V same cells beside N number rim k) i r'.
Proof.
  intros V same cells beside N number rim k i r r' [A [B [C [D [E [F [Nw G]]]]]]].
  assert (seekers V same N i r = seekers V same N i r') as S.
  { unfold seekers; rewrite C, E. assert (forall j, In j (seq 0 N) -> told r j = told r' j) as K
      by (intros j J; apply in_seq in J; apply G; lia).
    revert K; generalize [(place r', aim r')]; induction (seq 0 N) as [|j l IH]; intros m K; cbn; [reflexivity|].
    rewrite (K j) by now left. apply IH; intros; apply K; now right. }
  assert (forall u, targets V same cells beside r u = targets V same cells beside r' u) as T
    by (intros u; unfold targets; now rewrite A, B).
  assert (forall s, pairs V same cells beside number rim r s = pairs V same cells beside number rim r' s) as P.
  { intros s; unfold pairs; rewrite T; apply map_ext; intros c; unfold pair_of; now rewrite A, B. }
  assert (forall c, firsts V same cells beside r c = firsts V same cells beside r' c) as Fi
    by (intros c; unfold firsts; now rewrite A, C).
  cbn [chooses PAIRED]; rewrite S, P, A, C, E, Nw, (flat_map_ext _ _ P).
  destruct (first V _); [now rewrite Fi | reflexivity].
Qed.

(** ** The run. *)
Section Lasso.
  Variables (obstacle : nat -> bool) (N : nat) (rl : rule nat).
  Notation next := (next nat Nat.eqb obstacle N rl).
  Notation like := (like nat N).
  Hypothesis rl_like : forall i r r', like_robot nat N r r' -> chooses rl i r = chooses rl i r'.

  (** What a robot decides by, and a slot; as data. *)
  Definition shown_robot (r : robot nat) :=
    (explored r, blocked r, place r, doing r, aim r, waits r, news r, map (told r) (seq 0 N)).
  Definition shown (w : world nat) := (map (fun i => shown_robot (robots w i)) (seq 0 N), slot w, old w, tried w).
  Lemma map_all : forall (A : Type) (f g : nat -> A), map f (seq 0 N) = map g (seq 0 N) -> forall i, i < N -> f i = g i.
  Proof.
    intros A f g E i I. assert (In i (seq 0 N)) as J by (apply in_seq; lia). clear I; induction (seq 0 N) as [|k l IH]; [destruct J|].
    cbn [map] in E; injection E as E1 E2; destruct J as [->|J]; auto.
  Qed.
  Lemma shown_like : forall w w', shown w = shown w' -> like w w'.
  Proof.
    intros w w' E; unfold shown in E; injection E as E S O T; repeat split; auto; pose proof (map_all _ _ _ E i H) as R;
      unfold shown_robot in R; injection R as A B C D F G Nw To; auto; exact (map_all _ _ _ To).
  Qed.

  (** Worlds, the events between them, and the last event leads back. *)
  Variables (worlds : list (world nat)) (events : list (event nat)).
  Let first := nth 0 worlds (begins nat N (fun i => i)).
  Let at_ k := nth (k mod length events) worlds first.
  Let event k := nth (k mod length events) events Ticks.
  Hypothesis some_events : 0 < length events.
  Hypothesis leads_on : forall k, k < length events -> slot (at_ k) < N
    /\ exists x, next (at_ k) (event k) = Some x /\ shown x = shown (at_ (S k)).

  Fixpoint goes_on (n : nat) : world nat :=
    match n with O => first | S n => match next (goes_on n) (event n) with Some x => x | None => first end end.
  Lemma at_mod : forall n, at_ (n mod length events) = at_ n /\ event (n mod length events) = event n
    /\ at_ (S (n mod length events)) = at_ (S n).
  Proof.
    intros n; unfold at_, event; rewrite !Nat.mod_mod by lia; repeat split; f_equal.
    replace (S (n mod length events)) with (n mod length events + 1) by lia; rewrite Nat.add_mod_idemp_l by lia.
    f_equal; lia.
  Qed.
  Lemma goes_like : forall n, like (at_ n) (goes_on n) /\ exists x, next (goes_on n) (event n) = Some x /\ goes_on (S n) = x.
  Proof.
    assert (forall n, like (at_ n) (goes_on n) -> exists x, next (goes_on n) (event n) = Some x /\ goes_on (S n) = x
      /\ like (at_ (S n)) x) as St.
    { intros n L; destruct (leads_on (n mod length events)) as [Sl [x [E H]]]; [apply Nat.mod_upper_bound; lia|].
      destruct (at_mod n) as [M1 [M2 M3]]; rewrite M1, M2, M3 in *.
      destruct (next_like nat Nat.eqb obstacle N rl rl_like _ _ _ _ L Sl E) as [y [Y L']].
      exists y; cbn [goes_on]; rewrite Y; split; [reflexivity|]; split; [reflexivity|].
      exact (like_trans nat N _ _ _ (shown_like _ _ (eq_sym H)) L'). }
    assert (forall n, like (at_ n) (goes_on n)) as G.
    { induction n as [|n IH]; [|destruct (St n IH) as [x [_ [<- L]]]; exact L].
      cbn [goes_on]; unfold at_; rewrite Nat.mod_0_l by lia; apply shown_like; unfold first.
      clear; generalize (begins nat N (fun i => i)); destruct worlds; reflexivity. }
    intros n; split; [apply G|]. destruct (St n (G n)) as [x [X [Y _]]]; eauto.
  Qed.

  Variable cells : list nat.
  Hypothesis all_act : forall i, i < N -> exists k, k < length events
    /\ (acts nat i (event k) = true \/ able nat rl (at_ k) i = false).
  Hypothesis ticks : exists k, k < length events /\ event k = Ticks.
  Lemma come_again : forall n k, k < length events -> n <= length events * n + k
    /\ at_ (length events * n + k) = at_ k /\ event (length events * n + k) = event k.
  Proof.
    intros n k K; split; [nia|]; unfold at_, event.
    rewrite Nat.add_comm, Nat.mul_comm, Nat.mod_add by lia; auto.
  Qed.
  Lemma lasso : run nat Nat.eqb cells obstacle N rl first ->
    endless nat Nat.eqb cells obstacle N rl goes_on event /\ fair nat N rl goes_on event.
  Proof.
    intros R; split; [split; [exact R|]|split].
    - intros n; destruct (goes_like n) as [_ [x [X ->]]]; exists x; split; [exact X | apply alike_self].
    - intros i n I; destruct (all_act i I) as [k [K H]]; destruct (come_again n k K) as [L [A E]].
      exists (length events * n + k); split; [exact L|]. rewrite E; destruct H as [H|H]; [now left | right].
      rewrite <- A in H; rewrite <- H; destruct (goes_like (length events * n + k)) as [G _]; unfold able.
      now rewrite (moves_like nat N _ _ i G I), (may_decide_like nat N rl rl_like _ _ i G I).
    - intros n; destruct ticks as [k [K H]]; destruct (come_again n k K) as [L [_ E]].
      exists (length events * n + k); split; [exact L | left; congruence].
  Qed.
End Lasso.

Definition circle_story : story := snd endless_without_Keep.
Definition circle : list (event nat) := map snd circle_story.
Notation rl_ := (without_Keep 4 3 4).
Notation next_ := (next nat Nat.eqb (obstacle [0]) 4 rl_).
(** Where the kernel's run comes to its circle. *)
Notation at_last := (replay [0] 4 rl_ (begins_in 4 [9; 10; 5; 2]) (snd (fst endless_without_Keep))).
(** The world before each event. *)
Fixpoint passes (w : world nat) (es : list (event nat)) : list (world nat) :=
  match es with
  | [] => []
  | e :: es => w :: passes (match next_ w e with Some x => listed 4 x | None => w end) es
  end.

Section Circle.
  Variables (w : world nat) (ws : list (world nat)).
  Definition nth_world (k : nat) : world nat := nth (k mod length circle) ws (nth 0 ws (begins nat 4 (fun i => i))).
  Definition nth_event (k : nat) : event nat := nth (k mod length circle) circle Ticks.
  Definition comes_back : Prop :=
    map (fun k => option_map (shown 4) (next_ (nth_world k) (nth_event k))) (seq 0 (length circle))
      = map (fun k => Some (shown 4 (nth_world (S k)))) (seq 0 (length circle))
    /\ forallb (fun k => slot (nth_world k) <? 4) (seq 0 (length circle)) = true
    /\ forallb (fun i => existsb (fun k => acts nat i (nth_event k) || negb (able nat rl_ (nth_world k) i)) (seq 0 (length circle)))
         (seq 0 4) = true.
End Circle.

(** The kernel's run comes to its circle, by the rule in each state, and passes it. *)
Lemma begins_so : fst (fst (fst endless_without_Keep)) = ((4, 4, 3), [0]) /\ snd (fst (fst endless_without_Keep)) = [9; 10; 5; 2].
Proof. split; reflexivity. Qed.
Lemma circle_comes_back : match at_last with
  | Some w => match replay [0] 4 rl_ w circle_story with Some _ => True | None => False end /\ comes_back (passes w circle)
  | None => False
  end.
Proof. vm_compute; repeat split. Qed.

Lemma some_shown : forall (o : option (world nat)) y, option_map (shown 4) o = Some y -> exists x, o = Some x /\ shown 4 x = y.
Proof. intros [x|] y E; [|discriminate]; exists x; split; [reflexivity|]; cbn in E; congruence. Qed.

Theorem without_Keep_breaks_FRONTIER_3 : exists s e,
  endless nat Nat.eqb (cells 4 3) (obstacle [0]) 4 (without_Keep 4 3 4) s e /\ fair nat 4 (without_Keep 4 3 4) s e
  /\ at_last = Some (s 0) /\ forall n, e n = nth (n mod length circle) circle Ticks /\ missed nat (e n) = false.
Proof.
  pose proof circle_comes_back as C; destruct at_last as [w|] eqn:A; [|destruct C]. destruct C as [_ [C1 [C2 C3]]].
  set (ws := passes w circle) in *. assert (0 < length circle) as P by (vm_compute; repeat constructor).
  assert (nth 0 ws (begins nat 4 (fun i => i)) = w) as F by reflexivity. clearbody ws.
  destruct (lasso (obstacle [0]) 4 rl_ (paired_like nat Nat.eqb (cells 4 3) (beside 4 3) 4 (fun c => c) (rim 4 3) false) ws circle P) with (cells := cells 4 3) as [G H].
  - intros k K; split.
    + rewrite forallb_forall in C2; apply Nat.ltb_lt, (C2 k), in_seq; lia.
    + pose proof (map_all _ _ _ _ C1 k K) as E; unfold nth_world, nth_event in E.
      exact (some_shown _ _ E).
  - intros i I; rewrite forallb_forall in C3; specialize (C3 i ltac:(apply in_seq; lia)). apply existsb_exists in C3.
    destruct C3 as [k [K E]]; apply in_seq in K; exists k; split; [lia|]. apply orb_true_iff in E; rewrite negb_true_iff in E; exact E.
  - exists 0; split; [exact P | reflexivity].
  - rewrite F. refine (replay_runs 4 3 [0] 4 rl_ _ _ _ (begins_runs 4 3 [0] 4 rl_ [9; 10; 5; 2] eq_refl) _).
    exact A.
  - eexists _, _; split; [exact G|]; split; [exact H|]; split; [now rewrite <- F|].
    intros n; split; [reflexivity|]. assert (forallb (fun e => negb (missed nat e)) circle = true) as Q by reflexivity.
    rewrite forallb_forall in Q; apply negb_true_iff, Q, nth_In, Nat.mod_upper_bound; lia.
Qed.
