(** CHAIN-17 and, with it, CHAIN-7, 18 and 23 of the reel: a team move gains, a cell explored or a wall found, or the
    measure of the reel falls; so every run ends. What has been rehearsed comes in its number of team moves, and
    take-backs double.

    For every number of robots, every layout, and every choice of when to touch and of what to begin. A task is what
    [goes] makes of it: any function of the map, of the places of the robots and of the task. The kernel's are the
    approaches and the ways in and out of kernel/src/chain/reel.rs. ReelTie.v compares runs. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Rings Replay Reach.
From Tautline Require Frontier.
Import ListNotations.

(** What a team knows of the layout: the cells where robots have been, and walls. *)
Record chart := { seen : list cell; met : list edge }.

(** The reel's habits, those on which the measure rests here. *)
Record habits := { rehearses : bool; keeps_task : bool; doubles : bool }.
Definition ALL : habits := Build_habits true true true.

(** The team moves of a take-back, if so many have been begun since the last gain: 1, 2, 4, 8 ..., in 32 bits. *)
Definition many (begun : nat) : nat := if begun <? 32 then 2 ^ begun else pred (2 ^ 32).

(** Three numbers in lexicographic order. *)
Definition below (a b : nat * nat * nat) : Prop :=
  let '(a1, a2, a3) := a in let '(b1, b2, b3) := b in
  a1 < b1 \/ a1 = b1 /\ (a2 < b2 \/ a2 = b2 /\ a3 < b3).

Section Reel.
  Variables (N : nat) (rl : rule) (base : cell) (walls : list edge).
  (** Walls that are known from the beginning, as the border. *)
  Variable known : list edge.
  Variable habit : habits.

  (** One team move of a task by a team in these cells that knows these sides to be open, and the task after it. *)
  Variable task : Type.
  Variable goes : chart -> list edge -> task -> list cell -> option (list step * task).

  (** What the reel is at, with the team moves left of it; and how many take-backs have been begun since the last
      gain. *)
  Inductive doing := Nothing | At (t : task) (more : nat) | TakingBack (more : nat).
  Record memory := { is_at : doing; begun : nat }.
  Definition fresh : memory := {| is_at := Nothing; begun := 0 |}.

  (** The measure: [Reel::measure]. *)
  Definition measure (m : memory) : nat * nat * nat :=
    (255 - begun m, match is_at m with TakingBack _ => 1 | _ => 0 end,
      match is_at m with Nothing => 0 | At _ more | TakingBack more => more end).

  (** After a team move that gains nothing: [Reel::went_on]. *)
  Definition went_on (m : memory) : memory :=
    {| is_at := match is_at m with
         | At t (S (S more)) => At t (S more)
         | At _ _ | Nothing => Nothing
         | TakingBack more => TakingBack (pred more)
         end;
       begun := begun m |}.

  (** Where robots are sent. *)
  Definition sent (p : list cell) (pl : list step) : list cell :=
    tabulate N (fun i => after (team_of p i) (nth i pl Stay)).
  Definition explores (m : chart) (p : list cell) : bool := existsb (fun c => negb (is_in (seen m) c)) p.
  Definition is_free (m : chart) (p : list cell) (pl : list step) : bool :=
    every N (fun i => match nth i pl Stay with
      Cross s => negb (has (met m) (edge_of (team_of p i) s)) | Stay => true end).
  Definition admits (open : list edge) (p : list cell) (pl : list step) : bool :=
    admitted N rl base (state_of {| places := p; opened := open; made_so_far := [] |}) (plan_of pl).

  (** A rehearsal: the task explores a cell in just so many team moves, if no wall is met. *)
  Fixpoint explores_in (k : nat) (m : chart) (open : list edge) (t : task) (p : list cell) : bool :=
    match k with
    | O => false
    | S k =>
        match goes m open t p with
        | Some (pl, t) => if explores m (sent p pl) then k =? 0 else explores_in k m open t (sent p pl)
        | None => false
        end
    end.

  (** The reel at work: the team, what it knows, what it is at, whether the last team move has gained, and how many
      there were. *)
  Record reel := { team_at : listed; chart_of : chart; mind : memory; gained : bool; moves_made : nat }.
  Definition begins : reel :=
    {| team_at := list_start N base; chart_of := {| seen := [base]; met := known |}; mind := fresh; gained := true;
       moves_made := 0 |}.

  Definition remembers (x : reel) : memory := if gained x then fresh else mind x.
  Definition goes_on (x : reel) (t : task) : option (list step * task) :=
    goes (chart_of x) (opened (team_at x)) t (places (team_at x)).

  (** Nothing that was begun goes on. *)
  Definition is_idle (x : reel) : Prop :=
    match is_at (remembers x) with
    | Nothing => True
    | At t _ => if keeps_task habit then goes_on x t = None else True
    | TakingBack more => more = 0 \/ made_so_far (team_at x) = []
    end.

  (** The leader goes into an unexplored cell beside it. *)
  Definition touches (x : reel) (pl : list step) : Prop :=
    let p := places (team_at x) in
    admits (opened (team_at x)) p pl = true /\ is_free (chart_of x) p pl = true
    /\ is_in (seen (chart_of x)) (after (team_of p (pred N)) (nth (pred N) pl Stay)) = false.

  Definition back (pl : list step) : team_move := Backtrack (tabulate N (undo (plan_of pl))).

  (** What may be planned, and what is remembered then: [Chain::plan]. *)
  Inductive plans (x : reel) : team_move -> memory -> Prop :=
  | plans_touch : forall pl, touches x pl -> plans x (Advance pl) fresh
  | plans_on : forall t more pl t', is_at (remembers x) = At t more -> keeps_task habit = true ->
      goes_on x t = Some (pl, t') ->
      plans x (Advance pl) {| is_at := At t' more; begun := begun (remembers x) |}
  | plans_task : forall t more pl t', is_idle x -> 1 <= more ->
      (rehearses habit = true ->
        explores_in more (chart_of x) (opened (team_at x)) t (places (team_at x)) = true) ->
      goes_on x t = Some (pl, t') ->
      plans x (Advance pl) {| is_at := At t' more; begun := begun (remembers x) |}
  | plans_back_on : forall more pl rest, is_at (remembers x) = TakingBack (S more) ->
      made_so_far (team_at x) = pl :: rest -> plans x (back pl) (remembers x)
  | plans_back : forall pl rest, is_idle x -> made_so_far (team_at x) = pl :: rest ->
      plans x (back pl)
        {| is_at := TakingBack (many (begun (remembers x)));
           begun := if doubles habit then Nat.min (S (begun (remembers x))) 255 else begun (remembers x) |}.

  (** The sides at which a wall is met. *)
  Definition blocked (s : listed) (mv : team_move) : list edge :=
    match mv with
    | Advance pl => flat_map (fun i => match nth i pl Stay with
        | Cross side => let e := edge_of (team_of (places s) i) side in if stands walls e then [e] else []
        | Stay => []
        end) (seq 0 N)
    | Backtrack _ => []
    end.
  Definition finds (m : chart) (s : listed) (mv : team_move) : bool :=
    existsb (fun e => negb (has (met m) e)) (blocked s mv).
  Definition learns (m : chart) (s t : listed) (mv : team_move) : chart :=
    {| seen := fold_left grow (places t) (seen m); met := fold_left add (blocked s mv) (met m) |}.

  (** One team move: planned and made. [next] is that of Replay.v: an advance must be admitted, a backtrack is of the
      last advance that was not taken back. *)
  Inductive moves (x : reel) (mv : team_move) (m : memory) : reel -> Prop :=
  | moves_so : forall t, plans x mv m -> next N rl base walls (team_at x) mv = Some t ->
      let gain := explores (chart_of x) (places t) || finds (chart_of x) (team_at x) mv in
      moves x mv m {| team_at := t; chart_of := learns (chart_of x) (team_at x) t mv;
                      mind := if gain then m else went_on m; gained := gain; moves_made := S (moves_made x) |}.

  Inductive runs : reel -> Prop :=
  | runs_start : runs begins
  | runs_on : forall x mv m y, runs x -> moves x mv m y -> runs y.

  Definition endless (f : nat -> reel) : Prop := f 0 = begins /\ forall k, exists mv m, moves (f k) mv m (f (S k)).

  (** What is asked of tasks: what they do is admitted and leads over no known wall, and knowing more sides to be open
      changes nothing. *)
  Record sound_steps : Prop := {
    step_admitted : forall m open t p pl t', goes m open t p = Some (pl, t') -> admits open p pl = true;
    step_free : forall m open t p pl t', goes m open t p = Some (pl, t') -> is_free m p pl = true;
    step_kept : forall m open open' t p r, (forall e, has open e = true -> has open' e = true) ->
      goes m open t p = Some r -> goes m open' t p = Some r;
  }.
End Reel.

Arguments Nothing {task}.
Arguments At {task}.
Arguments TakingBack {task}.
Arguments is_at {task}.
Arguments begun {task}.
Arguments measure {task}.
Arguments went_on {task}.
Arguments team_at {task}.
Arguments chart_of {task}.
Arguments mind {task}.
Arguments gained {task}.
Arguments moves_made {task}.
Arguments remembers {task}.
Arguments touches N rl base {task}.

(** Maps that grow: what is known already changes nothing. *)
Lemma grow_none : forall more l, existsb (fun c => negb (is_in l c)) more = false -> fold_left grow more l = l.
Proof.
  induction more as [|c more IH]; intros l E; cbn in *; [reflexivity|].
  apply orb_false_iff in E; destruct E as [E F]. unfold grow at 2. destruct (is_in l c); [now apply IH | discriminate].
Qed.
Lemma add_none : forall more l, existsb (fun e => negb (has l e)) more = false -> fold_left add more l = l.
Proof.
  induction more as [|c more IH]; intros l E; cbn in *; [reflexivity|].
  apply orb_false_iff in E; destruct E as [E F]. unfold add at 2. destruct (has l c); [now apply IH | discriminate].
Qed.

(** ** The order of the measure. *)
Lemma below_wf : well_founded below.
Proof.
  intros [[a b] c]; revert b c; induction a as [a A] using lt_wf_ind.
  intros b; induction b as [b B] using lt_wf_ind. intros c; induction c as [c C] using lt_wf_ind.
  constructor; intros [[a' b'] c'] [L|[-> [L|[-> L]]]]; auto.
Qed.

Lemma no_descent : forall f : nat -> nat * nat * nat, (forall k, below (f (S k)) (f k)) -> False.
Proof.
  intros f D; assert (forall x k, f k = x -> False) as H; [|now apply (H (f 0) 0)].
  intros x; induction x as [x IH] using (well_founded_ind below_wf). intros k E.
  apply (IH (f (S k))) with (k := S k); [rewrite <- E; apply D | reflexivity].
Qed.

(** The team moves of the first take-backs. *)
Fixpoint all_of (begun : nat) : nat := match begun with O => 0 | S k => all_of k + many k end.

Lemma all_of_32 : forall k, k <= 32 -> S (all_of k) = 2 ^ k.
Proof.
  induction k as [|k IH]; intros L; [reflexivity|]. cbn [all_of]; unfold many.
  destruct (Nat.ltb_spec k 32); [|lia]. specialize (IH ltac:(lia)). rewrite Nat.pow_succ_r'; lia.
Qed.
Lemma many_pos : forall k, 1 <= many k.
Proof.
  intros k; unfold many. destruct (Nat.ltb_spec k 32) as [L|L].
  - pose proof (Nat.pow_nonzero 2 k); lia.
  - assert (2 ^ 1 <= 2 ^ 32) as H by (apply Nat.pow_le_mono_r; lia). rewrite Nat.pow_1_r in H; lia.
Qed.
Lemma all_of_mono : forall j k, j <= k -> all_of j <= all_of k.
Proof. intros j k L; induction L; cbn; lia. Qed.
(** With fewer than 2^32 team moves the count of take-backs never comes to its end. *)
Lemma few_begun : forall k, all_of k < 2 ^ 32 -> k < 33.
Proof.
  intros k L; destruct (Nat.ltb_spec k 33) as [|G]; [assumption|exfalso].
  apply all_of_mono in G. change (all_of 33) with (all_of 32 + many 32) in G.
  pose proof (all_of_32 32 ltac:(lia)); pose proof (many_pos 32); lia.
Qed.

Lemma list_eqb_refl : forall l, list_eqb step_eqb l l = true.
Proof. induction l as [|[[]|] l IH]; cbn; auto. Qed.

Section Falls.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge).
  Variable task : Type.
  Variable goes : chart -> list edge -> task -> list cell -> option (list step * task).
  Hypothesis two_robots : 2 <= N.
  Hypothesis has_safe_ahead : safe_ahead rl = true.
  Hypothesis sound : sound_steps N rl base task goes.

  Notation reel := (reel task).
  Notation moves := (moves N rl base walls ALL task goes).
  Notation runs := (runs N rl base walls known ALL task goes).
  Notation plans := (plans N rl base ALL task goes).
  Notation explores_in := (explores_in N task goes).
  Notation is_free := (is_free N).
  Notation sent := (sent N).

  Lemma explores_in_kept : forall k m o o' t p, (forall e, has o e = true -> has o' e = true) ->
    explores_in k m o t p = true -> explores_in k m o' t p = true.
  Proof.
    induction k as [|k IH]; intros m o o' t p O E; cbn in *; [discriminate|].
    destruct (goes m o t p) as [[pl t']|] eqn:G; [|discriminate].
    rewrite (step_kept _ _ _ _ _ sound _ _ _ _ _ _ O G). destruct (explores m (sent p pl)); [exact E | eauto].
  Qed.

  (** Where no wall is found all robots come where they are sent. *)
  Lemma all_come : forall m s pl t, is_free m (places s) pl = true ->
    finds N walls m s (Advance pl) = false -> next N rl base walls s (Advance pl) = Some t ->
    places t = sent (places s) pl /\ blocked N walls s (Advance pl) = []
    /\ (forall e, has (opened s) e = true -> has (opened t) e = true).
  Proof.
    intros m s pl t F W X. cbn [next] in X. destruct (admitted _ _ _ _ _); [|discriminate]. injection X as <-.
    assert (blocked N walls s (Advance pl) = []) as B.
    { destruct (blocked N walls s (Advance pl)) as [|e l] eqn:B; [reflexivity|exfalso].
      assert (In e (blocked N walls s (Advance pl))) as I by (rewrite B; now left).
      unfold finds in W; rewrite B in W; cbn in W; apply orb_false_iff in W; destruct W as [W _].
      cbn [blocked] in I; apply in_flat_map in I; destruct I as [i [I J]]; apply in_seq in I.
      unfold Reel.is_free in F; rewrite every_spec in F; specialize (F i ltac:(lia)).
      destruct (nth i pl Stay) as [side|]; [|destruct J]. destruct (stands walls _); [|destruct J].
      destruct J as [<-|[]]. rewrite F in W; discriminate. }
    assert (forall i, i < N -> made (stands walls) (team_of (places s)) (plan_of pl) i = nth i pl Stay) as M.
    { intros i L; unfold made, plan_of. destruct (arrives _ _ _) eqn:A; [reflexivity|exfalso].
      assert (blocked N walls s (Advance pl) <> []) as Z; [|contradiction]. clear B. intros B.
      cbn [blocked] in B. assert (In i (seq 0 N)) as I by (apply in_seq; lia).
      destruct (nth i pl Stay) as [side|] eqn:E; cbn in A; [|discriminate].
      assert (In (edge_of (team_of (places s) i) side) []) as [].
      rewrite <- B; apply in_flat_map; exists i; split; [exact I|]. rewrite E.
      destruct (stands walls _); [now left | discriminate]. }
    split; [|split; [exact B|]].
    - cbn [list_advance places]. unfold Reel.sent, tabulate at 1 3. apply map_ext_in; intros i I; apply in_seq in I.
      rewrite nth_tabulate by lia. now rewrite M by lia.
    - intros e E; cbn [list_advance opened]. rewrite has_fold, E; reflexivity.
  Qed.

  (** What gains nothing leaves the map as it is. *)
  Lemma map_kept : forall m s t mv, explores m (places t) = false -> finds N walls m s mv = false ->
    learns N walls m s t mv = m.
  Proof.
    intros [se me] s t mv E W; unfold learns; cbn [seen met]. f_equal; [now apply grow_none | now apply add_none].
  Qed.

  Lemma touch_gains : forall (x : reel) pl t, touches N rl base x pl ->
    next N rl base walls (team_at x) (Advance pl) = Some t ->
    explores (chart_of x) (places t) || finds N walls (chart_of x) (team_at x) (Advance pl) = true.
  Proof.
    intros x pl t [_ [F U]] X. destruct (finds _ _ _ _ _) eqn:W; [apply orb_true_r|]. rewrite orb_false_r.
    destruct (all_come _ _ _ _ F W X) as [-> _]. unfold explores; apply existsb_exists.
    eexists; split; [|rewrite U; reflexivity]. unfold Reel.sent, tabulate.
    apply (in_map (fun i => after (team_of (places (team_at x)) i) (nth i pl Stay))), in_seq; lia.
  Qed.

  (** A task under way is what was rehearsed; take-backs are no more than there were team moves. *)
  Definition goes_well (x : reel) : Prop :=
    gained x = true
    \/ (exists t k, is_at (mind x) = At t (S k)
        /\ explores_in (S k) (chart_of x) (opened (team_at x)) t (places (team_at x)) = true)
    \/ (exists k, is_at (mind x) = TakingBack k /\ all_of (begun (mind x)) <= k + moves_made x).

  Lemma begins_well : goes_well (begins N base known task).
  Proof. now left. Qed.

  (** One team move: it gains, or what was rehearsed goes on; or one team move more is taken back. *)
  Lemma advances : forall x pl t k t', goes_on task goes x t = Some (pl, t') ->
    explores_in k (chart_of x) (opened (team_at x)) t (places (team_at x)) = true ->
    forall u, next N rl base walls (team_at x) (Advance pl) = Some u ->
    finds N walls (chart_of x) (team_at x) (Advance pl) = false ->
    if k =? 1 then explores (chart_of x) (places u) = true
    else explores (chart_of x) (places u) = false
      /\ explores_in (pred k) (learns N walls (chart_of x) (team_at x) u (Advance pl)) (opened u) t' (places u) = true.
  Proof.
    intros x pl t k t' G E u X W. unfold goes_on in G.
    destruct (all_come _ _ _ _ (step_free _ _ _ _ _ sound _ _ _ _ _ _ G) W X) as [P [_ O]].
    destruct k as [|k]; [discriminate|]. cbn [Reel.explores_in] in E; rewrite G in E. rewrite P.
    destruct (explores (chart_of x) (sent (places (team_at x)) pl)) eqn:Q.
    - apply Nat.eqb_eq in E; subst; reflexivity.
    - destruct k as [|k]; [discriminate|]. cbn [Nat.eqb pred]. split; [reflexivity|].
      rewrite <- P in Q |- *. rewrite map_kept by assumption. eapply explores_in_kept; [exact O|]. now rewrite P.
  Qed.

  Lemma task_under_way : forall x, goes_well x -> forall t k, is_at (remembers x) = At t k ->
    1 <= k /\ explores_in k (chart_of x) (opened (team_at x)) t (places (team_at x)) = true.
  Proof.
    intros x G t k E; unfold remembers in E. destruct G as [G|G]; [rewrite G in E; discriminate|].
    destruct (gained x); [discriminate|].
    destruct G as [[t1 [k1 [A B]]]|[k1 [A _]]]; rewrite A in E; [|discriminate].
    injection E as <- <-; split; [lia | exact B].
  Qed.

  Lemma idle_begun : forall x, goes_well x -> is_idle ALL task goes x -> made_so_far (team_at x) <> [] ->
    all_of (begun (remembers x)) <= moves_made x
    /\ (gained x = false -> is_at (mind x) = TakingBack 0 /\ remembers x = mind x).
  Proof.
    intros x G I H; unfold is_idle, remembers in *. destruct (gained x) eqn:Y; [split; [cbn; lia | discriminate]|].
    destruct G as [G|[[t [k [A B]]]|[k [A B]]]]; [congruence | |]; rewrite A in I; cbn in I.
    - cbn in B; unfold goes_on in I; rewrite I in B; discriminate.
    - destruct I as [->|I]; [|contradiction]. split; [exact B | auto].
  Qed.

  (** What a planned team move is, of a reel that goes well. *)
  Inductive kind (x : reel) (mv : team_move) (m : memory task) : Prop :=
  | is_touch : forall pl, mv = Advance pl -> m = fresh task -> touches N rl base x pl -> kind x mv m
  | is_task : forall pl t k t', mv = Advance pl -> m = {| is_at := At t' k; begun := begun (remembers x) |} -> 1 <= k ->
      goes_on task goes x t = Some (pl, t') ->
      explores_in k (chart_of x) (opened (team_at x)) t (places (team_at x)) = true ->
      (gained x = true \/ (exists t0, is_at (mind x) = At t0 k)
       \/ exists l, is_at (mind x) = TakingBack l /\ (l = 0 \/ made_so_far (team_at x) = [])) -> kind x mv m
  | is_back_on : forall pl rest l, mv = back N pl -> made_so_far (team_at x) = pl :: rest -> m = mind x ->
      gained x = false -> is_at m = TakingBack (S l) -> all_of (begun m) <= S l + moves_made x -> kind x mv m
  | is_back : forall pl rest, mv = back N pl -> made_so_far (team_at x) = pl :: rest ->
      m = {| is_at := TakingBack (many (begun (remembers x))); begun := Nat.min (S (begun (remembers x))) 255 |} ->
      all_of (begun (remembers x)) <= moves_made x ->
      (gained x = false -> is_at (mind x) = TakingBack 0 /\ remembers x = mind x) -> kind x mv m.

  Lemma kinds : forall x mv m, goes_well x -> plans x mv m -> kind x mv m.
  Proof.
    intros x mv m G P. destruct P as [pl T | t k pl t' A K S | t k pl t' I L E S | k pl rest A H | pl rest I H].
    - now apply is_touch with pl.
    - destruct (task_under_way x G t k A) as [L E]. eapply is_task; eauto.
      unfold remembers in A; destruct (gained x); [now left | right; left; eauto].
    - eapply is_task; eauto. destruct (gained x) eqn:Y; [now left | right]. unfold is_idle, remembers in I.
      rewrite Y in I. destruct G as [G|[[t1 [k1 [A B]]]|[k1 [A _]]]]; 
        [congruence | exfalso | right; rewrite A in I; eauto].
      rewrite A in I; cbn in I, B. unfold goes_on in I; rewrite I in B; discriminate.
    - unfold remembers in *; destruct (gained x) eqn:Y; [discriminate|].
      eapply is_back_on; eauto. destruct G as [G|[[t1 [k1 [B _]]]|[k1 [B C]]]]; [congruence | congruence|].
      rewrite A in B; injection B as <-; exact C.
    - destruct (idle_begun x G I) as [B C]; [congruence|]. eapply is_back; eauto.
  Qed.

  Lemma goes_well_on : forall x mv m y, goes_well x -> moves x mv m y -> goes_well y.
  Proof.
    intros x mv m y G M; destruct M as [t P X gain]. unfold goes_well; cbn [gained mind chart_of team_at moves_made].
    destruct gain eqn:Y; [now left | right]. unfold gain in Y; apply orb_false_iff in Y; destruct Y as [Y W].
    destruct (kinds _ _ _ G P)
      as [pl -> -> T | pl t0 k t' -> -> L S E _ | pl rest l -> H -> _ A B | pl rest -> H -> B _].
    - pose proof (touch_gains _ _ _ T X) as Z. rewrite Y, W in Z; discriminate.
    - left. pose proof (advances _ _ _ _ _ S E _ X W) as Z. destruct (Nat.eqb_spec k 1) as [->|D]; [congruence|].
      destruct k as [|[|k]]; try lia. cbn in Z; cbn. exists t', k; split; [reflexivity | apply Z].
    - right; exists l; unfold went_on; rewrite A; cbn; split; [reflexivity | lia].
    - right; unfold went_on; cbn [is_at begun]. eexists; split; [reflexivity|].
      pose proof (many_pos (begun (remembers x))).
      assert (all_of (Nat.min (S (begun (remembers x))) 255) <= all_of (S (begun (remembers x)))) as Z
        by (apply all_of_mono; lia).
      change (all_of (S (begun (remembers x)))) with (all_of (begun (remembers x)) + many (begun (remembers x))) in Z.
      lia.
  Qed.

  Lemma runs_well : forall x, runs x -> goes_well x.
  Proof. intros x R; induction R; [apply begins_well | eapply goes_well_on; eauto]. Qed.

  Lemma falls : forall x mv m y, goes_well x -> moves x mv m y ->
    gained y = true \/ below (measure (mind y)) (measure m).
  Proof.
    intros x mv m y G M; destruct M as [t P X gain]. cbn [gained mind].
    destruct gain eqn:Y; [now left | right]. unfold gain in Y; apply orb_false_iff in Y; destruct Y as [Y W].
    destruct (kinds _ _ _ G P)
      as [pl -> -> T | pl t0 k t' -> -> L S E _ | pl rest l -> H -> _ A B | pl rest -> H -> B _].
    - pose proof (touch_gains _ _ _ T X) as Z. rewrite Y, W in Z; discriminate.
    - destruct k as [|[|k]]; unfold measure, went_on, below; cbn [is_at begun]; lia.
    - unfold measure, went_on, below; rewrite A; cbn [is_at begun]; lia.
    - pose proof (many_pos (begun (remembers x))). unfold measure, went_on, below; cbn [is_at begun]; lia.
  Qed.

  Lemma begins_less : forall x mv m, goes_well x -> moves_made x < 2 ^ 32 -> plans x mv m -> gained x = false ->
    (exists pl, mv = Advance pl /\ touches N rl base x pl) \/ m = mind x \/ measure m = measure (mind x)
    \/ below (measure m) (measure (mind x)).
  Proof.
    intros x mv m G F P Y.
    destruct (kinds _ _ _ G P)
      as [pl -> -> T | pl t0 k t' -> -> L S E B | pl rest l -> H -> _ A B | pl rest -> H -> B C].
    - left; eauto.
    - right; right. unfold remembers; rewrite Y. destruct B as [B|[[t1 B]|[l [B _]]]]; [congruence | |];
        unfold measure, below; rewrite B; cbn [is_at begun]; [left; reflexivity | right; lia].
    - right; now left.
    - right; right; right. destruct (C Y) as [C1 C2]; rewrite C2 in *.
      pose proof (few_begun (begun (mind x)) ltac:(lia)).
      unfold measure, below; rewrite C1; cbn [is_at begun]; lia.
  Qed.

  (** ** Gains are finitely many. *)
  Lemma next_length : forall s mv t, next N rl base walls s mv = Some t -> List.length (places t) = N.
  Proof.
    intros s mv t X; destruct mv as [pl|pl]; cbn in X.
    - destruct (admitted _ _ _ _ _); [|discriminate]; injection X as <-; cbn. unfold tabulate.
      now rewrite map_length, seq_length.
    - destruct (made_so_far s); [discriminate|]. destruct (list_eqb _ _ _); [|discriminate]; injection X as <-; cbn.
      unfold tabulate; now rewrite map_length, seq_length.
  Qed.

  (** A run of the reel is a run of Team.v. *)
  Lemma runs_reachable : forall x, runs x -> reachable N rl base (stands walls) (state_of (team_at x))
    /\ List.length (places (team_at x)) = N.
  Proof.
    intros x R; induction R as [|x mv m y R [IH _] M].
    - split; [eexists; apply run_start, alike_start | apply repeat_length].
    - destruct M as [t P X gain]; split; [eapply next_reachable; eauto | eapply next_length; eauto].
  Qed.

  (** The cells at most N-1 rings from the base. *)
  Definition numbers : list Z := map (fun i => (Z.of_nat i - Z.of_nat (N - 1))%Z) (seq 0 (2 * N - 1)).
  Definition ball : list cell := map (fun o => (fst base + fst o, snd base + snd o)%Z) (list_prod numbers numbers).
  Definition sides_of : list edge := flat_map (fun c => map (edge_of c) all_sides) ball.

  Lemma in_numbers : forall z, (Z.abs z <= Z.of_nat (N - 1))%Z -> In z numbers.
  Proof.
    intros z H; apply in_map_iff; exists (Z.to_nat (z + Z.of_nat (N - 1))); split; [lia|]. apply in_seq; lia.
  Qed.
  Lemma in_ball : forall c, (ring base c <= Z.of_nat (N - 1))%Z -> In c ball.
  Proof.
    intros [x y] H; apply in_map_iff; unfold ring, apart_x, apart_y in H; cbn [fst snd] in H.
    exists (x - fst base, y - snd base)%Z; split; [cbn [fst snd]; f_equal; lia|].
    apply in_prod; apply in_numbers; lia.
  Qed.
  Lemma places_in_ball : forall s, reachable N rl base (stands walls) (state_of s) ->
    forall i, i < N -> In (team_of (places s) i) ball.
  Proof.
    intros s [past R] i L. pose proof (in_rings_always N rl base (stands walls) two_robots has_safe_ahead _ _ R) as F.
    destruct (ring_by_time N rl base (stands walls) two_robots _ _ R) as [[older ->] _].
    inversion F as [|? ? C _]; subst. specialize (C i L). cbn in C. apply in_ball; lia.
  Qed.

  Lemma side_of : forall s, reachable N rl base (stands walls) (state_of s) ->
    forall i side, i < N -> In (edge_of (team_of (places s) i) side) sides_of.
  Proof.
    intros s R i side L. apply in_flat_map; exists (team_of (places s) i). split; [now apply places_in_ball|].
    apply in_map; destruct side; cbn; auto.
  Qed.

  Definition unknown (m : chart) : nat :=
    List.length (filter (fun c => negb (is_in (seen m) c)) ball)
    + List.length (filter (fun e => negb (has (met m) e)) sides_of).

  Lemma filter_more : forall (A : Type) (f g : A -> bool) l, (forall a, g a = true -> f a = true) ->
    List.length (filter g l) <= List.length (filter f l).
  Proof.
    intros A f g l H; induction l as [|a l IH]; cbn; [lia|].
    destruct (g a) eqn:G; [rewrite (H a G); cbn; lia | destruct (f a); cbn; lia].
  Qed.

  Lemma seen_grows : forall m s t mv c, is_in (seen m) c = true -> is_in (seen (learns N walls m s t mv)) c = true.
  Proof. intros m s t mv c H; apply is_in_spec, grow_spec; left; now apply is_in_spec. Qed.
  Lemma met_grows : forall m s t mv e, has (met m) e = true -> has (met (learns N walls m s t mv)) e = true.
  Proof. intros m s t mv e H; unfold learns; cbn [met]; rewrite has_fold, H; reflexivity. Qed.

  Lemma counts : forall m s mv t, reachable N rl base (stands walls) (state_of s) ->
    next N rl base walls s mv = Some t ->
    if explores m (places t) || finds N walls m s mv then unknown (learns N walls m s t mv) < unknown m
    else learns N walls m s t mv = m.
  Proof.
    intros m s mv t RX X. pose proof (next_reachable _ _ _ _ _ _ _ RX X) as RY. pose proof (next_length _ _ _ X) as LY.
    destruct (_ || _) eqn:Y; [|apply orb_false_iff in Y; destruct Y; now apply map_kept].
    unfold unknown. set (m' := learns N walls m s t mv).
    assert (forall c, negb (is_in (seen m') c) = true -> negb (is_in (seen m) c) = true) as A.
    { intros c H; destruct (is_in (seen m) c) eqn:E; [|reflexivity].
      unfold m' in H; rewrite seen_grows in H by exact E; discriminate. }
    assert (forall e, negb (has (met m') e) = true -> negb (has (met m) e) = true) as B.
    { intros e H; destruct (has (met m) e) eqn:E; [|reflexivity].
      unfold m' in H; rewrite met_grows in H by exact E; discriminate. }
    pose proof (filter_more _ _ _ ball A) as A'; pose proof (filter_more _ _ _ sides_of B) as B'. cbn beta in A', B'.
    apply orb_true_iff in Y; destruct Y as [Y|Y]; apply existsb_exists in Y; destruct Y as [c [I U]].
    - assert (List.length (filter (fun c => negb (is_in (seen m') c)) ball)
        < List.length (filter (fun c => negb (is_in (seen m) c)) ball)); [|lia].
      apply Frontier.filter_less; [exact A|]. exists c; split; [|split; [exact U|]].
      + apply In_nth with (d := (0, 0)%Z) in I; destruct I as [i [L <-]]. rewrite LY in L.
        now apply places_in_ball.
      + apply negb_false_iff, is_in_spec, grow_spec; now right.
    - assert (List.length (filter (fun e => negb (has (met m') e)) sides_of)
        < List.length (filter (fun e => negb (has (met m) e)) sides_of)); [|lia].
      apply Frontier.filter_less; [exact B|]. exists c; split; [|split; [exact U|]].
      + unfold blocked in I; destruct mv as [pl|pl]; [|destruct I]. apply in_flat_map in I; destruct I as [i [I J]].
        apply in_seq in I. destruct (nth i pl Stay) as [side|]; [|destruct J]. destruct (stands walls _); [|destruct J].
        destruct J as [<-|[]]. apply side_of; [exact RX | lia].
      + apply negb_false_iff. unfold m', learns; cbn [met]. rewrite has_fold. apply orb_true_iff; right.
        apply existsb_exists; exists c; split; [exact I | now apply edge_eqb_spec].
  Qed.

  Lemma gain_counts : forall x mv m y, runs x -> moves x mv m y ->
    if gained y then unknown (chart_of y) < unknown (chart_of x) else chart_of y = chart_of x.
  Proof.
    intros x mv m y R M. destruct (runs_reachable _ R) as [RX _]. destruct M as [t P X gain].
    cbn [gained chart_of]. now apply counts.
  Qed.

  (** ** Every run ends: what is unknown, tasks, the history. *)
  Definition rank (x : reel) : nat * nat * nat :=
    (unknown (chart_of x),
     if gained x then 2 else match is_at (mind x) with At _ _ => 0 | _ => 1 end,
     if gained x then 0 else match is_at (mind x) with At _ k => k | _ => List.length (made_so_far (team_at x)) end).

  Lemma rank_falls : forall x mv m y, runs x -> moves x mv m y -> below (rank y) (rank x).
  Proof.
    intros x mv m y R M. pose proof (gain_counts _ _ _ _ R M) as C. pose proof (runs_well _ R) as G.
    pose proof (goes_well_on _ _ _ _ G M) as G'. unfold rank.
    destruct (gained y) eqn:Y; [unfold below; now left|]. rewrite C. unfold below; right; split; [reflexivity|].
    destruct M as [t P X gain]; cbn [gained mind team_at chart_of] in *. rewrite Y.
    destruct (kinds _ _ _ G P)
      as [pl -> -> T | pl t0 k t' -> -> L S E B | pl rest l -> H -> Z A B | pl rest -> H -> B D].
    - pose proof (touch_gains _ _ _ T X). unfold gain in Y; congruence.
    - unfold went_on; cbn [is_at]. destruct k as [|[|k]]; [lia | |].
      + destruct G' as [G'|[[t1 [k1 [A _]]]|[k1 [A _]]]]; [cbn in G'; congruence | |]; cbn in A; rewrite Y in A;
          cbn in A; discriminate.
      + destruct (gained x) eqn:W; [left; lia|].
        destruct B as [B|[[t1 B]|[l [B _]]]]; [congruence | |]; rewrite B;
          [right; split; [reflexivity | lia] | left; lia].
    - rewrite Z. unfold went_on; rewrite A; cbn [is_at]. right; split; [reflexivity|].
      unfold back in X; cbn [next] in X; rewrite H in X. destruct (list_eqb _ _ _); [|discriminate]. injection X as <-.
      cbn [list_backtrack made_so_far]. rewrite H; cbn; lia.
    - unfold went_on; cbn [is_at]. destruct (gained x) eqn:W; [left; lia|].
      destruct (D eq_refl) as [D1 _]; rewrite D1. right; split; [reflexivity|].
      unfold back in X; cbn [next] in X; rewrite H in X. destruct (list_eqb _ _ _); [|discriminate]. injection X as <-.
      cbn [list_backtrack made_so_far]. rewrite H; cbn; lia.
  Qed.

  Lemma no_endless : forall f, ~ endless N rl base walls known ALL task goes f.
  Proof.
    intros f [B E]. assert (forall k, runs (f k)) as R.
    { induction k as [|k IH]; [rewrite B; apply runs_start|]. destruct (E k) as [mv [m M]]; eapply runs_on; eauto. }
    apply (no_descent (fun k => rank (f k))). intros k; destruct (E k) as [mv [m M]]. eapply rank_falls; eauto.
  Qed.

  (** Whatever is planned can be made. *)
  Lemma every_plan_is_made : forall x mv m, runs x -> plans x mv m -> exists y, moves x mv m y.
  Proof.
    intros x mv m R P. assert (exists t, next N rl base walls (team_at x) mv = Some t) as [t X].
    { assert (forall o p pl, admits N rl base o p pl = true -> admitted N rl base
        (state_of {| places := p; opened := o; made_so_far := made_so_far (team_at x) |}) (plan_of pl) = true) as A
        by (intros o p pl A; exact A).
      destruct (kinds _ _ _ (runs_well _ R) P)
        as [pl -> -> T | pl t0 k t' -> -> L S E B | pl rest l -> H -> Z C B | pl rest -> H -> B D].
      - destruct T as [T _]; apply A in T. cbn [next]. destruct (team_at x); cbn in *; rewrite T; eauto.
      - apply (step_admitted _ _ _ _ _ sound) in S; apply A in S. cbn [next]. destruct (team_at x); cbn in *;
          rewrite S; eauto.
      - cbn [next back]. rewrite H, list_eqb_refl; eauto.
      - cbn [next back]. rewrite H, list_eqb_refl; eauto. }
    eexists; now apply moves_so with (t := t).
  Qed.
End Falls.

(** ** The theorems. *)
Section Clauses.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge) (habit : habits).
  Variables (task : Type) (goes : chart -> list edge -> task -> list cell -> option (list step * task)).

  (** A team move gains, or the measure falls; and what is begun without a gain has no greater one. *)
  Definition measure_falls : Prop := forall x mv m y, runs N rl base walls known habit task goes x ->
    moves_made x < 2 ^ 32 -> moves N rl base walls habit task goes x mv m y ->
    (gained y = true \/ below (measure (mind y)) (measure m))
    /\ (gained x = true \/ gained y = true \/ measure m = measure (mind x) \/ below (measure m) (measure (mind x))).
End Clauses.

(** CHAIN-17. Each team move gains, or brings the measure down; so every run ends. *)
Theorem CHAIN_17 : forall N rl base walls known task goes, 2 <= N -> safe_ahead rl = true ->
  sound_steps N rl base task goes ->
  measure_falls N rl base walls known ALL task goes /\ forall f, ~ endless N rl base walls known ALL task goes f.
Proof.
  intros N rl base walls known task goes L H K; split; [|intros f; now apply no_endless].
  intros x mv m y R F M.
  pose proof (runs_well N rl base walls known task goes L K x R) as G.
  split; [eapply falls; eauto|]. destruct (gained x) eqn:X; [now left | right].
  pose proof M as M'. destruct M' as [t P Y gain]. cbn [gained].
  destruct (begins_less N rl base task goes L x mv m G F P X) as [[pl [-> T]]|[->|B]]; auto.
  left; unfold gain. eapply touch_gains; eauto.
Qed.

(** CHAIN-7 of the reel. No run is endless: it ends where nothing is planned, since whatever is planned can be made. *)
Theorem CHAIN_7 : forall N rl base walls known task goes, 2 <= N -> safe_ahead rl = true ->
  sound_steps N rl base task goes ->
  (forall f, ~ endless N rl base walls known ALL task goes f)
  /\ forall x mv m, runs N rl base walls known ALL task goes x -> plans N rl base ALL task goes x mv m ->
     exists y, moves N rl base walls ALL task goes x mv m y.
Proof.
  intros N rl base walls known task goes L H K; split; [intros f; now apply no_endless|].
  intros; eapply every_plan_is_made; eauto.
Qed.

(** CHAIN-18. Where no wall is found, the last of the team moves that were rehearsed explores a cell, and none before
    it. *)
Theorem CHAIN_18 : forall N rl base walls known task goes, 2 <= N -> safe_ahead rl = true ->
  sound_steps N rl base task goes ->
  forall x mv m y t k, runs N rl base walls known ALL task goes x -> moves N rl base walls ALL task goes x mv m y ->
  is_at m = At t k -> finds N walls (chart_of x) (team_at x) mv = false ->
  if k =? 1 then explores (chart_of x) (places (team_at y)) = true
  else explores (chart_of x) (places (team_at y)) = false /\ is_at (mind y) = At t (pred k).
Proof.
  intros N rl base walls known task goes L H K x mv m y t k R M A W.
  pose proof (runs_well N rl base walls known task goes L K x R) as G. destruct M as [u P X gain].
  cbn [team_at mind].
  destruct (kinds N rl base task goes L x mv m G P)
    as [pl -> -> T | pl t0 k0 t' -> -> L' S E _ | pl rest l -> H' -> _ B _ | pl rest -> H' -> _ _].
  - discriminate.
  - injection A as <- <-. pose proof (advances N rl base walls task goes L K x pl t0 k0 t' S E u X W) as Z.
    destruct (Nat.eqb_spec k0 1) as [->|D]; [exact Z|]. destruct Z as [Z _]; split; [exact Z|].
    unfold gain; rewrite Z, W; cbn [orb]. unfold went_on; cbn [is_at].
    destruct k0 as [|[|k0]]; [lia | lia | reflexivity].
  - rewrite B in A; discriminate.
  - discriminate.
Qed.

(** CHAIN-23. Team moves are taken back in a take-back, which goes on until its team moves are made, the history ends,
    or something is gained; one that is begun has 1, 2, 4, 8 ... of them. *)
Theorem CHAIN_23 : forall N rl base walls known task goes, 2 <= N -> safe_ahead rl = true ->
  sound_steps N rl base task goes ->
  forall x mv m y, runs N rl base walls known ALL task goes x -> moves_made x < 2 ^ 32 ->
  moves N rl base walls ALL task goes x mv m y ->
  ((exists pl, mv = Backtrack pl) <-> exists k, is_at m = TakingBack k)
  /\ (forall k, is_at (remembers x) = TakingBack (S k) -> made_so_far (team_at x) <> [] -> gained y = false ->
     m = mind x /\ is_at (mind y) = TakingBack k)
  /\ (forall k, is_at m = TakingBack k -> m = remembers x /\ (exists l, k = S l)
     \/ k = many (begun (remembers x)) /\ begun m = S (begun (remembers x))).
Proof.
  intros N rl base walls known task goes L H K x mv m y R F M.
  pose proof (runs_well N rl base walls known task goes L K x R) as G. destruct M as [u P X gain].
  cbn [team_at mind gained].
  destruct (kinds N rl base task goes L x mv m G P)
    as [pl -> -> T | pl t0 k0 t' -> -> L' S E Y | pl rest l -> H' -> Y B _ | pl rest -> H' -> B D].
  - assert (gain = true) as -> by (unfold gain; eapply touch_gains; eauto).
    split; [split; intros [? E]; discriminate|]. split; [discriminate | discriminate].
  - split; [split; intros [? E0]; discriminate|]. split; [|discriminate].
    intros k A Z _; exfalso. unfold remembers in A. destruct Y as [Y|[[t1 Y]|[l [Y [->|Y']]]]]; try contradiction;
      try (rewrite Y in A; discriminate); destruct (gained x); try discriminate; rewrite Y in A; discriminate.
  - assert (remembers x = mind x) as Q by (unfold remembers; now rewrite Y). rewrite Q.
    split; [split; intros _; [eauto | unfold back; eauto]|]. split.
    + intros k A Z E. split; [reflexivity|]. rewrite E. unfold went_on; cbn [is_at]. now rewrite A.
    + intros k A; left; split; [reflexivity|]. rewrite B in A; injection A as <-; eauto.
  - split; [split; intros _; [cbn [is_at]; eauto | unfold back; eauto]|]. split.
    + intros k A Z E. exfalso. unfold remembers in A. destruct (gained x) eqn:W; [discriminate|].
      destruct (D eq_refl) as [D1 _]; rewrite D1 in A; discriminate.
    + cbn [is_at begun]. intros k A; right; injection A as <-; split; [reflexivity|].
      pose proof (few_begun (begun (remembers x)) ltac:(lia)). lia.
Qed.
