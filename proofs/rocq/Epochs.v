(** CHAIN-7 of the paper's planner: every run ends, as published and repaired.

    For every number of robots and every layout. The leader has virtual obstacles, which are cleared when an epoch ends.
    A plan of the team puts a virtual obstacle at each candidate of the leader that is refused; if it puts none, the
    leader comes nearer to the nearest unexplored cell. How far that is, [dist] says: any function of the map and of the
    virtual obstacles will do. EpochsTie.v compares runs. *)
From Coq Require Import ZArith Lia Bool List Arith Relations Wellfounded.
From Tautline Require Import Lattice Rule Team Contact Rings Unfolding Replay Reach Reel Scripts.
From Tautline Require Frontier.
Import ListNotations.

(** Distances: none is the farthest. *)
Definition nearer (a b : option nat) : Prop :=
  match a, b with Some a, Some b => a < b | Some _, None => True | None, _ => False end.

Lemma nearer_wf : well_founded nearer.
Proof.
  assert (forall n, Acc nearer (Some n)) as S.
  { intros n; induction n as [n IH] using lt_wf_ind. constructor; intros [m|] L; [now apply IH | destruct L]. }
  intros [n|]; [apply S|]. constructor; intros [m|] L; [apply S | destruct L].
Qed.

(** How far an epoch is: it has gained; it has not yet; or the chain is being unfolded, by these team moves. *)
Inductive stage := Gained | Seeking | Unfolding (t : script).

Section Epochs.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge).
  (** Whether an epoch must gain for the next one to begin, and whether that may begin by unfolding the chain. *)
  Variables (must_gain may_unfold : bool).
  Variable dist : chart -> list edge -> cell -> option nat.

  Record chain := { team_at : listed; chart_of : chart; virtual : list edge; stage_of : stage }.
  Definition begins : chain :=
    {| team_at := list_start N base; chart_of := {| seen := [base]; met := known |}; virtual := [];
      stage_of := Gained |}.

  Definition leader_of (p : list cell) : cell := team_of p (pred N).

  (** What a plan may do to the leader's candidates: each that is refused gets a virtual obstacle, and is on no side
      that has one. *)
  Definition refuses (virtual : list edge) (p : list cell) (new : list edge) : Prop :=
    forall e, In e new -> has virtual e = false /\ exists side, e = edge_of (leader_of p) side.

  (** The team follows a candidate: nothing is refused only if the leader comes nearer. *)
  Definition leads (m : chart) (open virtual : list edge) (p : list cell) (new : list edge) (pl : list step) : Prop :=
    refuses virtual p new /\ admits N rl base open p pl = true /\ Reel.is_free N m p pl = true
    /\ (new = [] ->
        nearer (dist m virtual (after (leader_of p) (nth (pred N) pl Stay))) (dist m virtual (leader_of p))).

  (** It can follow none: no candidate is refused only if there is no way to an unexplored cell. *)
  Definition fails (m : chart) (virtual : list edge) (p : list cell) (new : list edge) : Prop :=
    refuses virtual p new /\ (new = [] -> dist m virtual (leader_of p) = None).

  Definition is_seeking (s : stage) : Prop := match s with Unfolding _ => False | _ => True end.

  (** What may be planned, the virtual obstacles then, and how far the epoch is: [Chain::plan]. *)
  Inductive plans (x : chain) : team_move -> list edge -> stage -> Prop :=
  | plans_lead : forall new pl, is_seeking (stage_of x) ->
      leads (chart_of x) (opened (team_at x)) (virtual x) (places (team_at x)) new pl ->
      plans x (Advance pl) (new ++ virtual x) (stage_of x)
  | plans_back : forall new pl rest, is_seeking (stage_of x) ->
      fails (chart_of x) (virtual x) (places (team_at x)) new -> made_so_far (team_at x) = pl :: rest ->
      plans x (back N pl) (new ++ virtual x) (stage_of x)
  | plans_epoch : forall refused new pl, (stage_of x = Gained \/ must_gain = false /\ stage_of x = Seeking) ->
      fails (chart_of x) (virtual x) (places (team_at x)) refused -> made_so_far (team_at x) = [] ->
      leads (chart_of x) (opened (team_at x)) [] (places (team_at x)) new pl ->
      plans x (Advance pl) new Seeking
  | plans_unfolding : forall refused t pl more, may_unfold = true -> (stage_of x = Gained \/ stage_of x = Seeking) ->
      fails (chart_of x) (virtual x) (places (team_at x)) refused -> made_so_far (team_at x) = [] ->
      explores_in N script (follows N rl base) (length t) (chart_of x) (opened (team_at x)) t (places (team_at x))
        = true ->
      follows N rl base (chart_of x) (opened (team_at x)) t (places (team_at x)) = Some (pl, more) ->
      plans x (Advance pl) [] (Unfolding more)
  | plans_on : forall t pl more, stage_of x = Unfolding t ->
      follows N rl base (chart_of x) (opened (team_at x)) t (places (team_at x)) = Some (pl, more) ->
      plans x (Advance pl) (virtual x) (Unfolding more).

  (** One team move: planned and made. *)
  Inductive moves (x : chain) (mv : team_move) (v : list edge) (s : stage) : chain -> Prop :=
  | moves_so : forall t, plans x mv v s -> next N rl base walls (team_at x) mv = Some t ->
      moves x mv v s {| team_at := t; chart_of := learns N walls (chart_of x) (team_at x) t mv; virtual := v;
        stage_of :=
          if explores (chart_of x) (places t) || finds N walls (chart_of x) (team_at x) mv then Gained else s |}.

  Inductive runs : chain -> Prop :=
  | runs_start : runs begins
  | runs_on : forall x mv v s y, runs x -> moves x mv v s y -> runs y.

  Definition endless (f : nat -> chain) : Prop := f 0 = begins /\ forall k, exists mv v s, moves (f k) mv v s (f (S k)).

  Hypothesis two_robots : 2 <= N.
  Hypothesis has_safe_ahead : safe_ahead rl = true.
  Hypothesis has_must_gain : must_gain = true.

  Lemma runs_reachable : forall x, runs x -> reachable N rl base (stands walls) (state_of (team_at x)).
  Proof.
    intros x R; induction R as [|x mv v s y R IH M]; [eexists; apply run_start, alike_start|].
    destruct M as [t P X]; cbn [team_at]. eapply next_reachable; eauto.
  Qed.

  (** What is left of an unfolding explores a cell. *)
  Definition unfolds_well (x : chain) : Prop := forall t, stage_of x = Unfolding t ->
    explores_in N script (follows N rl base) (length t) (chart_of x) (opened (team_at x)) t (places (team_at x)) = true.

  Lemma follows_on : forall m s t pl more u,
    explores_in N script (follows N rl base) (length t) m (opened s) t (places s) = true ->
    follows N rl base m (opened s) t (places s) = Some (pl, more) -> next N rl base walls s (Advance pl) = Some u ->
    explores m (places u) || finds N walls m s (Advance pl) = false ->
    length t = S (length more)
    /\ explores_in N script (follows N rl base) (length more) (learns N walls m s u (Advance pl)) (opened u) more
         (places u) = true.
  Proof.
    intros m s t pl more u E F X G. apply orb_false_iff in G; destruct G as [G W].
    destruct t as [|q t]; [discriminate|]. assert (is_free N m (places s) pl = true /\ more = t) as [K ->].
    { cbn in F. destruct (admits _ _ _ _ _ _ && Reel.is_free _ _ _ _) eqn:A; [|discriminate]. injection F as <- <-.
      apply andb_true_iff in A; tauto. }
    split; [reflexivity|]. cbn [length explores_in] in E; rewrite F in E.
    destruct (all_come N rl base walls two_robots _ _ _ _ K W X) as [P [_ O]]. rewrite <- P, G in E.
    rewrite (map_kept N walls) by assumption.
    eapply explores_in_kept; [apply scripts_sound | exact O | exact E].
  Qed.

  Lemma runs_unfold_well : forall x, runs x -> unfolds_well x.
  Proof.
    intros x R; induction R as [|x mv v s y R IH M]; [intros t E; discriminate|].
    destruct M as [u P X]. intros t E; cbn [stage_of chart_of team_at] in *.
    destruct (explores (chart_of x) (places u) || finds N walls (chart_of x) (team_at x) mv) eqn:G; [discriminate|].
    destruct P as [new pl K _ | new pl rest K _ _ | refused new pl _ _ _ _ | refused q pl more _ _ _ _ Q F
      | q pl more K F].
    - rewrite E in K; destruct K.
    - rewrite E in K; destruct K.
    - discriminate.
    - injection E as ->. now apply (follows_on (chart_of x) (team_at x) q pl t u).
    - injection E as ->. apply (follows_on (chart_of x) (team_at x) q pl t u); auto.
  Qed.

  (** ** What falls: the unknown; how far the epoch is; the sides without a virtual obstacle, or what is left of the
      unfolding; the distance; the history. *)
  Definition bare (v : list edge) : nat :=
    length (filter (fun e => negb (has v e)) (sides_of N base)).
  Definition rank (x : chain) : nat * nat * nat * option nat * nat :=
    (unknown N base (chart_of x),
     match stage_of x with Gained => 2 | Seeking => 1 | Unfolding _ => 0 end,
     match stage_of x with Unfolding t => length t | _ => bare (virtual x) end,
     match stage_of x with Unfolding _ => None
       | _ => dist (chart_of x) (virtual x) (leader_of (places (team_at x))) end,
     match stage_of x with Unfolding _ => 0 | _ => length (made_so_far (team_at x)) end).
  Definition lower : nat * nat * nat * option nat * nat -> nat * nat * nat * option nat * nat -> Prop :=
    slexprod _ _ (slexprod _ _ (slexprod _ _ (slexprod _ _ lt lt) lt) nearer) lt.

  Lemma lower_wf : well_founded lower.
  Proof. repeat apply wf_slexprod; try apply lt_wf. apply nearer_wf. Qed.

  Lemma lower_spec : forall a b c d e a' b' c' d' e',
    a < a' \/ a = a' /\ (b < b' \/ b = b' /\ (c < c' \/ c = c' /\ (nearer d d' \/ d = d' /\ e < e'))) ->
    lower (a, b, c, d, e) (a', b', c', d', e').
  Proof.
    intros a b c d e a' b' c' d' e' H. unfold lower. destruct H as [H|[-> [H|[-> [H|[-> [H|[-> H]]]]]]]].
    - now do 4 apply left_slex.
    - do 3 apply left_slex; now apply right_slex.
    - do 2 apply left_slex; now apply right_slex.
    - apply left_slex; now apply right_slex.
    - now apply right_slex.
  Qed.

  Lemma bare_falls : forall v p new, (exists side, In (edge_of (leader_of p) side) new
    /\ has v (edge_of (leader_of p) side) = false
      /\ In (edge_of (leader_of p) side) (sides_of N base)) -> bare (new ++ v) < bare v.
  Proof.
    intros v p new [side [I [H K]]]. apply Frontier.filter_less.
    - intros e E; destruct (has v e) eqn:V; [|reflexivity]. unfold has in *;
        rewrite existsb_app, V, orb_true_r in E; discriminate.
    - exists (edge_of (leader_of p) side); split; [exact K|]. split; [now rewrite H|].
      apply negb_false_iff. unfold has; rewrite existsb_app; apply orb_true_iff; left.
      apply existsb_exists; eexists; split; [exact I | now apply edge_eqb_spec].
  Qed.

  Lemma refused_falls : forall x new, runs x -> refuses (virtual x) (places (team_at x)) new -> new <> [] ->
    bare (new ++ virtual x) < bare (virtual x).
  Proof.
    intros x new R F E. destruct new as [|e new]; [contradiction|]. destruct (F e (or_introl eq_refl)) as [H [side ->]].
    apply bare_falls with (p := places (team_at x)); exists side. split; [now left|]. split; [exact H|].
    unfold leader_of; eapply side_of; [exact two_robots | exact has_safe_ahead | now apply runs_reachable | lia].
  Qed.

  Lemma rank_falls : forall x mv v s y, runs x -> moves x mv v s y -> lower (rank y) (rank x).
  Proof.
    intros x mv v s y R M. pose proof (runs_unfold_well _ R) as W. pose proof (runs_reachable _ R) as RX.
    destruct M as [u P X].
    pose proof (counts N rl base walls two_robots has_safe_ahead (chart_of x) _ _ _ RX X) as C.
    unfold rank; cbn [chart_of stage_of team_at virtual]. apply lower_spec.
    destruct (explores (chart_of x) (places u) || finds N walls (chart_of x) (team_at x) mv) eqn:G; [now left|].
    right; rewrite C; split; [reflexivity|].
    destruct P as [new pl K L | new pl rest K F H | refused new pl K _ _ L | refused t pl more _ K _ H Q F
      | t pl more K F].
    - destruct L as [F [A [Z D]]]. right; split; [reflexivity|].
      assert (leader_of (places u) = after (leader_of (places (team_at x))) (nth (pred N) pl Stay)) as E.
      { apply orb_false_iff in G; destruct G as [_ G].
      destruct (all_come N rl base walls two_robots _ _ _ _ Z G X) as [E _].
        unfold leader_of; rewrite E. unfold sent, team_of at 1. now rewrite nth_tabulate by lia. }
      destruct (stage_of x); [| | destruct K]; rewrite E;
        (destruct new as [|e new]; [right; split; [reflexivity|]; left; now apply D|];
         left; eapply refused_falls; eauto; discriminate).
    - destruct F as [F D]. right; split; [reflexivity|].
      assert (length (made_so_far u) < length (made_so_far (team_at x))) as E.
      { unfold back in X; cbn [next] in X; rewrite H in X. destruct (list_eqb _ _ _); [|discriminate].
      injection X as <-.
        cbn [list_backtrack made_so_far]. rewrite H; cbn; lia. }
      destruct (stage_of x); [| | destruct K];
        (destruct new as [|e new]; [|left; eapply refused_falls; eauto; discriminate]; right; split; [reflexivity|];
         cbn [app]; rewrite (D eq_refl); destruct (dist _ _ (leader_of (places u))); [left; exact I | right; auto]).
    - destruct K as [K|[K _]]; [rewrite K; left; lia | congruence].
    - left; destruct K as [K|K]; rewrite K; lia.
    - rewrite K. right; split; [reflexivity|].
      destruct (follows_on (chart_of x) (team_at x) t pl more u (W t K) F X G) as [E _]. left; rewrite E; lia.
  Qed.

  Lemma no_endless : forall f, ~ endless f.
  Proof.
    intros f [B E]. assert (forall k, runs (f k)) as R.
    { induction k as [|k IH]; [rewrite B; apply runs_start|]. destruct (E k) as [mv [v [s M]]]; eapply runs_on; eauto. }
    assert (forall x k, rank (f k) = x -> False) as H; [|now apply (H (rank (f 0)) 0)].
    intros x; induction x as [x IH] using (well_founded_ind lower_wf). intros k Q.
    destruct (E k) as [mv [v [s M]]]. apply (IH (rank (f (S k)))) with (k := S k); [|reflexivity].
    rewrite <- Q; eapply rank_falls; eauto.
  Qed.
End Epochs.

(** CHAIN-7 of the paper's planner. No run is endless: it ends where nothing is planned, since whatever is planned can
    be made. *)
Theorem CHAIN_7 : forall N rl base walls known may_unfold dist, 2 <= N -> safe_ahead rl = true ->
  (forall f, ~ endless N rl base walls known true may_unfold dist f)
  /\ forall x mv v s, plans N rl base true may_unfold dist x mv v s ->
     exists y, moves N rl base walls true may_unfold dist x mv v s y.
Proof.
  intros N rl base walls known may_unfold dist L H; split; [intros f; eapply no_endless; eauto|].
  intros x mv v s P. assert (exists t, next N rl base walls (team_at x) mv = Some t) as [t X]; [|eexists;
    eapply moves_so; eauto].
  assert (forall pl, admits N rl base (opened (team_at x)) (places (team_at x)) pl = true ->
    exists t, next N rl base walls (team_at x) (Advance pl) = Some t) as A.
  { intros pl A; unfold admits in A. cbn [next]. destruct (team_at x) as [p o l]; cbn [opened places] in A.
    change (admitted N rl base (state_of {| places := p; opened := o; made_so_far := l |}) (plan_of pl) = true) in A.
    rewrite A; eauto. }
  assert (forall t pl more, Scripts.follows N rl base (chart_of x) (opened (team_at x)) t (places (team_at x)) =
    Some (pl, more) ->
    admits N rl base (opened (team_at x)) (places (team_at x)) pl = true) as S
    by (intros; eapply (step_admitted _ _ _ _ _ (scripts_sound N rl base)); eauto).
  destruct P as [new pl _ P | new pl rest _ _ P | refused new pl _ _ _ P | refused t pl more _ _ _ _ _ P
    | t pl more _ P];
    [apply A, P | | apply A, P | eapply A, S; eauto | eapply A, S; eauto].
  cbn [next back]. rewrite P, list_eqb_refl; eauto.
Qed.

(** ** Whenever an unexplored cell is within reach by the map, a chain that is all in the base can be unfolded so that
    it explores a cell: along any walk with the fewest links. *)
Section Arrives.
  Variables (N : nat) (base : cell) (m : chart) (open : list edge).
  Variables (n : nat) (c : cell) (walk : nat -> cell) (length : nat) (stop : nat -> nat).
  Hypothesis two_robots : 2 <= N.
  Hypothesis enough : n <= N - 1.
  Hypothesis way : is_way (has (met m)) base n c walk length stop.
  Hypothesis base_seen : is_in (seen m) base = true.
  Hypothesis unseen : is_in (seen m) c = false.

  Definition cells_after (k : nat) : list cell := tabulate N (fun i => walk (places_after N n stop k i)).
  Definition steps_after (k : nat) : list step := tabulate N (plan_after N n walk stop k).

  Lemma team_after : forall k i, i < N -> team_of (cells_after k) i = walk (places_after N n stop k i).
  Proof. intros k i L; unfold team_of, cells_after; now rewrite nth_tabulate. Qed.
  Lemma plan_is : forall k i, i < N -> nth i (steps_after k) Stay = plan_after N n walk stop k i.
  Proof. intros k i L; unfold steps_after; now rewrite nth_tabulate. Qed.

  Lemma follows_after : forall k t, Scripts.follows N REPAIRED base m open (steps_after k :: t) (cells_after k)
    = Some (steps_after k, t) /\ sent N (cells_after k) (steps_after k) = cells_after (S k).
  Proof.
    intros k t.
    pose proof (plan_leads N base (has (met m)) n c walk length stop two_robots enough way) as G.
    assert (forall i, i < N -> after (team_of (cells_after k) i) (nth i (steps_after k) Stay)
      = walk (places_after N n stop (S k) i)) as E.
    { intros i L; rewrite team_after, plan_is by exact L. apply (G k i L). }
    split; [|unfold sent, cells_after at 2; apply map_ext_in; intros i I; apply in_seq in I; apply E; lia].
    cbn [Scripts.follows].
    assert (admits N REPAIRED base open (cells_after k) (steps_after k) = true) as ->.
    { unfold admits.
      destruct (CHAIN_13_step N base walk length (stops_at N n stop) two_robots
        (a_walk base (has (met m)) n c walk length stop way)
        (the_stops N base (has (met m)) n c walk length stop two_robots enough way)) as [_ K].
      apply (proj2 (K _ (on_it N base (has (met m)) n c walk length stop two_robots enough way k))).
      - intros i L; cbn [pos state_of places]. rewrite team_after by exact L. split; [reflexivity|].
        rewrite <- team_after by exact L. apply E; exact L.
      - cbn [pos state_of places]. rewrite team_after by lia.
        destruct (on_it N base (has (met m)) n c walk length stop two_robots enough way k) as [Z _]; rewrite Z;
          apply way. }
    assert (Reel.is_free N m (cells_after k) (steps_after k) = true) as ->; [|reflexivity].
    apply every_spec; intros i L. rewrite plan_is by exact L. destruct (G k i L) as [_ A].
    rewrite team_after by exact L. destruct (plan_after N n walk stop k i) as [side|]; [exact A | reflexivity].
  Qed.

  Lemma explores_by : forall r k, 1 <= r -> explores m (cells_after (k + r)) = true ->
    exists r', explores_in N script (Scripts.follows N REPAIRED base) r' m open (map steps_after (seq k r'))
      (cells_after k) = true.
  Proof.
    induction r as [|r IH]; intros k R E; [lia|]. destruct (explores m (cells_after (S k))) eqn:G.
    - exists 1. cbn [seq map explores_in]. destruct (follows_after k []) as [-> ->]. now rewrite G.
    - destruct r as [|r]; [replace (k + 1) with (S k) in E by lia; congruence|].
      destruct (IH (S k) ltac:(lia)) as [r' H]; [now replace (S k + S r) with (k + S (S r)) by lia|].
      exists (S r'). cbn [seq map explores_in]. destruct (follows_after k (map steps_after (seq (S k) r'))) as [-> ->].
      now rewrite G.
  Qed.

  Lemma arrives_there : exists t,
    explores_in N script (Scripts.follows N REPAIRED base) (List.length t) m open t (repeat base N) = true.
  Proof.
    destruct (explores_by length 0) as [r H].
    - destruct length eqn:L; [|lia]. pose proof (way_ends _ _ _ _ _ _ _ way) as E.
      rewrite (way_begins _ _ _ _ _ _ _ way) in E. rewrite E in base_seen; congruence.
    - unfold explores; apply existsb_exists; exists c; split; [|now rewrite unseen].
      replace c with (walk (places_after N n stop (0 + length) (pred N))).
      + apply (in_map (fun i => walk (places_after N n stop (0 + length) i))), in_seq; lia.
      + cbn [plus]. rewrite (leader_goes N base (has (met m)) n c walk length stop two_robots enough way) by lia.
        apply way.
    - exists (map steps_after (seq 0 r)). rewrite map_length, seq_length.
      replace (repeat base N) with (cells_after 0); [exact H|]. unfold cells_after, tabulate; cbn [places_after].
      rewrite (way_begins _ _ _ _ _ _ _ way). rewrite <- (seq_length N 0) at 2.
      generalize (seq 0 N) as l. induction l as [|i l IH]; cbn; [reflexivity | now rewrite IH].
  Qed.
End Arrives.

(** So the unfolding that [plans] asks for is there. *)
Theorem unfolding_arrives : forall N base m open c, 2 <= N -> is_in (seen m) base = true ->
  In c (reached (has (met m)) base (N - 1)) -> is_in (seen m) c = false ->
  exists t, explores_in N script (Scripts.follows N REPAIRED base) (List.length t) m open t (repeat base N) = true.
Proof.
  intros N base m open c L B I U. destruct (fewest_links _ _ _ _ I) as [n [M [J F]]].
  destruct (way_to _ _ _ _ J F) as [walk [length [stop W]]].
  exact (arrives_there N base m open n c walk length stop L M W B U).
Qed.

(** Without EpochMustGain there is an endless run: an epoch in which the leader's candidate is refused, and nobody goes,
    ends when that is taken back, and the next is the same. *)
Theorem epochs_must_gain : exists f, endless 2 PUBLISHED (0, 0)%Z [] [] false false (fun _ _ _ => None) f.
Proof.
  set (o := (0, 0)%Z). set (wait := [Stay; Stay]). set (east := edge_of o East).
  set (x := fun l v s => {| team_at := {| places := [o; o]; opened := []; made_so_far := l |};
    chart_of := {| seen := [o]; met := [] |}; virtual := v; stage_of := s |}).
  set (even := x [] [east] Seeking). set (odd := x [wait] [east] Seeking).
  exists (fun k => match k with O => begins 2 o [] | S k => if Nat.even k then odd else even end).
  split; [reflexivity|].
  assert (refuses 2 [] [o; o] [east]) as R by (intros e [<-|[]]; split; [reflexivity | exists East; reflexivity]).
  assert (leads 2 PUBLISHED o (fun _ _ _ => None) {| seen := [o]; met := [] |} [] [] [o; o] [east] wait) as G
    by (split; [exact R | repeat split; try (vm_compute; reflexivity); discriminate]).
  assert (forall v, fails 2 (fun _ _ _ => None) {| seen := [o]; met := [] |} v [o; o] []) as F
    by (intros v; split; [intros e [] | reflexivity]).
  assert (forall y, stage_of y = Gained \/ false = false /\ stage_of y = Seeking -> team_at y = team_at even ->
    chart_of y = chart_of even ->
    moves 2 PUBLISHED o [] false false (fun _ _ _ => None) y (Advance wait) [east] Seeking odd) as E.
  { intros y S T C. assert (odd = {| team_at := list_advance 2 [] (team_at y) wait;
      chart_of := learns 2 [] (chart_of y) (team_at y) (list_advance 2 [] (team_at y) wait) (Advance wait);
        virtual := [east];
      stage_of := if explores (chart_of y) (places (list_advance 2 [] (team_at y) wait))
        || finds 2 [] (chart_of y) (team_at y) (Advance wait) then Gained else Seeking |}) as -> by (rewrite T, C;
          reflexivity).
    apply moves_so; [|rewrite T; reflexivity]. apply plans_epoch with (refused := []); rewrite ?T, ?C; auto. }
  intros [|k]; [do 3 eexists; apply E; auto|].
  change (exists mv v s,
    moves 2 PUBLISHED o [] false false (fun _ _ _ => None) (if Nat.even k then odd else even) mv v s
    (if Nat.even (S k) then odd else even)).
  rewrite Nat.even_succ, <- Nat.negb_even. destruct (Nat.even k); cbn [negb].
  - exists (back 2 wait), ([] ++ [east]), Seeking.
    assert (even = {| team_at := list_backtrack 2 [] (team_at odd) wait [];
      chart_of := learns 2 [] (chart_of odd) (team_at odd) (list_backtrack 2 [] (team_at odd) wait []) (back 2 wait);
      virtual := [] ++ [east];
      stage_of := if explores (chart_of odd) (places (list_backtrack 2 [] (team_at odd) wait []))
        || finds 2 [] (chart_of odd) (team_at odd) (back 2 wait) then Gained else Seeking |}) as Q by reflexivity.
    rewrite Q. apply moves_so; [|reflexivity]. eapply plans_back with (new := []); [exact I | apply F | reflexivity].
  - do 3 eexists; apply E; auto.
Qed.
