(** Ants [Ferranti 2009]: every cell counts how often it was entered, and an ant goes to a side neighbour that counts
    least. For every number of ants, every finite connected floor, every order of actions, every way to settle ties and
    whatever sensors are missed: a run of more actions than a stated number has entered every cell. The number hangs
    on how many actions miss a sensor. AntsTie.v compares the definitions with what the kernel answers. *)
From Coq Require Import Lia Bool List Arith.
Import ListNotations.

(** The count of a sensor placed where none was seen: it says 1, and what was missed is lost, stays beside it, or is
    counted on; or it counts on from the cell that the ant comes from. [Once] is no rule of the kernel: a sensor that
    says 1 however often its cell is entered. *)
Inductive rule := Lost | Beside | Counted | Repaired | Once.

(** What a cell that counts [there] and reads as [read] counts once an ant has entered from one that counts [own]. *)
Definition says (r : rule) (own there read : nat) : nat :=
  match r, read with
  | Once, _ => 1
  | _, S _ => S there
  | Lost, O => 1
  | Beside, O => Nat.max there 1
  | Counted, O => S there
  | Repaired, O => S (pred own)
  end.

Section Floor.
  Variables (V : Type) (same : V -> V -> bool) (beside : V -> list V).

  (** What the cells count, 0 where no ant has been, and where the ants are. *)
  Record state := { count : V -> nat; at_ : nat -> V }.
  Definition set (f : V -> nat) (v : V) (n : nat) : V -> nat := fun x => if same x v then n else f x.
  Definition put (p : nat -> V) (i : nat) (v : V) : nat -> V := fun j => if j =? i then v else p j.

  (** A sensor that is missed reads as that of a cell where no ant has been. *)
  Definition reads (missed : V -> bool) (s : state) (x : V) : nat := if missed x then 0 else count s x.

  (** Ant [i] enters [v], which reads as [read]. *)
  Definition enter (r : rule) (s : state) (i : nat) (v : V) (read : nat) : state :=
    {| count := set (count s) v (says r (count s (at_ s i)) (count s v) read); at_ := put (at_ s) i v |}.

  (** Where an ant goes of the cells [near], in their order: the first of those that read least. *)
  Definition least (read : V -> nat) (near : list V) : option V :=
    hd_error (filter (fun v => forallb (fun x => read v <=? read x) near) near).

  Variables (cells : list V) (N : nat) (first : V -> nat).

  (** Runs of so many actions, of which so many missed a sensor. *)
  Inductive run (r : rule) : nat -> nat -> state -> Prop :=
  | start : forall p, (forall i, i < N -> In (p i) cells) -> run r 0 0 {| count := first; at_ := p |}
  | act : forall m k s i missed v, run r m k s -> i < N -> In v (beside (at_ s i)) ->
      (forall x, In x (beside (at_ s i)) -> reads missed s v <= reads missed s x) ->
      run r (if existsb missed (beside (at_ s i)) then S m else m) (S k) (enter r s i v (reads missed s v)).

  (** [u] is so many steps from [w]. *)
  Inductive steps (w : V) : nat -> V -> Prop :=
  | steps_0 : steps w 0 w
  | steps_S : forall d u x, steps w d x -> In x (beside u) -> steps w (S d) u.

  (** The most neighbours of a cell, the most steps between two cells, the most that a cell counts at first. *)
  Variables (D M C0 : nat).
  Record is_floor : Prop := {
    same_spec : forall a b, same a b = true <-> a = b;
    mutual : forall u v, In v (beside u) -> In u (beside v);
    closed : forall u v, In u cells -> In v (beside u) -> In v cells;
    few : forall u, length (beside u) <= D;
    connected : forall w u, In w cells -> In u cells -> exists d, d <= M /\ steps w d u;
    small : forall u, first u <= C0;
  }.

  (** The most that a cell counts [d] steps from one that nobody has entered, if no cell counts more than [c] and from
      there on no sensor is missed or placed; for how many actions that can go on. *)
  Fixpoint most (c d : nat) : nat := match d with O => 0 | S d => c + N + D * S (most c d) end.
  Definition calm_for (c : nat) : nat := length cells * (D * S (most c (S M))).
  (** The most that a cell counts after [j] actions that miss or place a sensor, and how many actions that takes. *)
  Fixpoint counts (j : nat) : nat := match j with O => C0 | S j => counts j + calm_for (counts j) + 1 end.
  Fixpoint takes (j : nat) : nat := match j with O => 0 | S j => takes j + calm_for (counts j) + 1 end.
  (** Enough actions, if [m] miss a sensor. *)
  Definition enough (m : nat) : nat := takes (S (m + length cells)).
End Floor.

Section Sums.
  Variables (V : Type) (same : V -> V -> bool).
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.

  Definition sum (l : list V) (f : V -> nat) : nat := list_sum (map f l).
  Lemma sum_cons : forall y r f, sum (y :: r) f = f y + sum r f. Proof. reflexivity. Qed.
  Lemma sum_le : forall l f g, (forall x, In x l -> f x <= g x) -> sum l f <= sum l g.
  Proof.
    induction l as [|y r IH]; intros f g H; [reflexivity|]. rewrite !sum_cons.
    assert (sum r f <= sum r g) by (apply IH; intros; apply H; now right).
    pose proof (H y (or_introl eq_refl)); lia.
  Qed.
  Lemma sum_lt : forall l f g, (forall x, f x <= g x) -> (exists y, In y l /\ f y < g y) -> sum l f < sum l g.
  Proof.
    induction l as [|z r IH]; intros f g H [y [I L]]; [destruct I|]. rewrite !sum_cons; destruct I as [->|I].
    - pose proof (sum_le r f g (fun x _ => H x)); lia.
    - assert (sum r f < sum r g) by (apply IH; eauto); pose proof (H z); lia.
  Qed.
  Lemma sum_most : forall l f b, (forall x, In x l -> f x <= b) -> sum l f <= length l * b.
  Proof.
    induction l as [|y r IH]; intros f b H; [reflexivity|]. rewrite sum_cons; cbn [length Nat.mul].
    assert (sum r f <= length r * b) by (apply IH; intros; apply H; now right).
    pose proof (H y (or_introl eq_refl)); lia.
  Qed.

  Definition more (f : V -> nat) (v : V) : V -> nat := set V same f v (S (f v)).
  Lemma set_same : forall f v n, set V same f v n v = n.
  Proof. intros; unfold set; now rewrite (proj2 (same_spec v v) eq_refl). Qed.
  Lemma set_other : forall f v n x, same x v = false -> set V same f v n x = f x.
  Proof. intros f v n x E; unfold set; now rewrite E. Qed.
  Lemma more_same : forall f v, more f v v = S (f v). Proof. intros; apply set_same. Qed.
  Lemma more_le : forall f v x, f x <= more f v x <= S (f x).
  Proof. intros; unfold more, set; destruct (same x v) eqn:E; [apply same_spec in E; subst|]; lia. Qed.
End Sums.

(** Actions that neither miss nor place a sensor, from a state [s0] in which no cell counts more than [c]. *)
Section Calm.
  Variables (V : Type) (same : V -> V -> bool) (beside : V -> list V) (cells : list V) (N D c : nat).
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis mutual : forall u v, In v (beside u) -> In u (beside v).
  Hypothesis closed : forall u v, In u cells -> In v (beside u) -> In v cells.
  Hypothesis few : forall u, length (beside u) <= D.
  Variable s0 : state V.
  Hypothesis small : forall u, count V s0 u <= c.
  Hypothesis inside : forall i, i < N -> In (at_ V s0 i) cells.
  Notation count := (count V). Notation at_ := (at_ V). Notation more := (more V same). Notation put := (put V).

  (** How many actions, what came of them, and how often each cell was left. *)
  Inductive calm : nat -> state V -> (V -> nat) -> Prop :=
  | calm_start : calm 0 s0 (fun _ => 0)
  | calm_act : forall k s l i v, calm k s l -> i < N -> In v (beside (at_ s i)) ->
      (forall x, In x (beside (at_ s i)) -> count s v <= count s x) ->
      calm (S k) {| Ants.count := more (count s) v; Ants.at_ := put (at_ s) i v |} (more l (at_ s i)).

  Lemma calm_inside : forall k s l, calm k s l -> forall i, i < N -> In (at_ s i) cells.
  Proof.
    intros k s l R; induction R as [|k s l i v R IH L B Mi]; [exact inside|]. intros j J; cbn; unfold Ants.put.
    destruct (j =? i); eauto.
  Qed.

  Lemma calm_counts : forall k s l, calm k s l -> forall u, count s u <= c + k.
  Proof.
    intros k s l R; induction R as [|k s l i v R IH L B Mi]; intros u; cbn; [specialize (small u); lia|].
    pose proof (more_le V same same_spec (count s) v u); specialize (IH u); lia.
  Qed.

  (** How many ants are in a cell. *)
  Definition here (p : nat -> V) (u : V) : nat := length (filter (fun i => same (p i) u) (seq 0 N)).
  Definition bit (b : bool) : nat := if b then 1 else 0.
  Lemma here_put : forall p i v u, i < N -> here (put p i v) u + bit (same (p i) u) = here p u + bit (same v u).
  Proof.
    intros p i v u L; unfold here.
    assert (forall n, (n <= i -> length (filter (fun j => same (put p i v j) u) (seq 0 n))
      = length (filter (fun j => same (p j) u) (seq 0 n))) /\ (i < n -> length (filter (fun j => same (put p i v j) u)
      (seq 0 n)) + bit (same (p i) u) = length (filter (fun j => same (p j) u) (seq 0 n)) + bit (same v u))) as H.
    { induction n as [|n [A B]]; [split; [reflexivity | lia]|].
      rewrite seq_S, !filter_app, !app_length; cbn [filter Nat.add].
      unfold Ants.put at 2 4; destruct (Nat.eqb_spec n i) as [->|E].
      - split; [lia|]; intros _; rewrite A by lia. destruct (same v u), (same (p i) u); cbn; lia.
      - split; intros Q; [rewrite A by lia | assert (i < n) as Z by lia; specialize (B Z)];
          destruct (same (p n) u); cbn; lia. }
    now apply H.
  Qed.

  Lemma here_most : forall p u, here p u <= N.
  Proof.
    intros p u; unfold here; rewrite <- (seq_length N 0) at 2. generalize (seq 0 N) as l.
    induction l as [|x r IH]; cbn; [lia|]; destruct (same (p x) u); cbn; lia.
  Qed.

  Lemma more_bit : forall f v u, more f v u = f u + bit (same v u).
  Proof.
    intros f v u; unfold Ants.more, set. replace (same u v) with (same v u)
      by (apply eq_true_iff_eq; rewrite !same_spec; intuition).
    destruct (same v u) eqn:E; cbn; [apply same_spec in E; subst|]; lia.
  Qed.

  (** An ant that comes into a cell either stays or leaves. *)
  Lemma balance : forall k s l, calm k s l -> forall u, count s u <= count s0 u + l u + here (at_ s) u.
  Proof.
    intros k s l R; induction R as [|k s l i v R IH L B Mi]; intros u; cbn [Ants.count Ants.at_]; [lia|].
    specialize (IH u); pose proof (here_put (at_ s) i v u L) as P. rewrite !more_bit. lia.
  Qed.

  (** Beside a cell that counts [K] at most, each departure goes to a cell that does so, too. *)
  Lemma departures : forall k s l, calm k s l -> forall u x K, In x (beside u) -> count s x <= K ->
    l u <= sum V (beside u) (fun v => Nat.min (count s v) (S K)).
  Proof.
    intros k s l R; induction R as [|k s l i v R IH L B Mi]; intros u x K X E; cbn [Ants.count] in *; [lia|].
    assert (count s x <= K) as E' by (pose proof (more_le V same same_spec (count s) v x); lia).
    specialize (IH u x K X E'). rewrite more_bit; destruct (same (at_ s i) u) eqn:U; cbn [bit].
    - apply same_spec in U; subst u. specialize (Mi x X). rewrite Nat.add_1_r.
      apply Nat.le_lt_trans with (1 := IH); apply sum_lt.
      + intros y; pose proof (more_le V same same_spec (count s) v y); lia.
      + exists v; split; [exact B|]; rewrite (more_same V same same_spec); lia.
    - rewrite Nat.add_0_r; etransitivity; [exact IH|]; apply sum_le; intros y _.
      pose proof (more_le V same same_spec (count s) v y); lia.
  Qed.

  Lemma nobody_leaves_alone : forall k s l, calm k s l -> forall u, beside u = [] -> l u = 0.
  Proof.
    intros k s l R; induction R as [|k s l i v R IH L B Mi]; intros u E; [reflexivity|]. rewrite more_bit, (IH u E).
    destruct (same (at_ s i) u) eqn:U; [apply same_spec in U; rewrite U, E in B; destruct B | reflexivity].
  Qed.

  Notation most := (most N D c).
  Lemma most_le : forall d e, d <= e -> most d <= most e.
  Proof.
    assert (forall d, most d <= most (S d)) as A.
    { induction d as [|d IH]; [apply Nat.le_0_l|]; cbn [Ants.most] in *; nia. }
    intros d e L; induction L as [|e L IH]; [lia|]; specialize (A e); lia.
  Qed.

  Variables (k : nat) (s : state V) (l : V -> nat) (w : V).
  Hypothesis R : calm k s l.
  Hypothesis unentered : count s w = 0.

  Lemma left_most : forall d u x, In x (beside u) -> count s x <= most d -> l u <= D * S (most d).
  Proof.
    intros d u x X E; pose proof (departures k s l R u x _ X E) as Y. etransitivity; [exact Y|].
    etransitivity; [apply (sum_most _ _ _ (S (most d))); intros; lia|]. pose proof (few u); nia.
  Qed.

  Lemma counts_most : forall d u, steps V beside w d u -> count s u <= most d.
  Proof.
    intros d u S; induction S as [|d u x S IH X]; [cbn; lia|].
    pose proof (balance k s l R u); pose proof (left_most d u x X IH); pose proof (small u).
    pose proof (here_most (at_ s) u); cbn [Ants.most]; lia.
  Qed.

  Variable M : nat.
  Hypothesis connected : forall u, In u cells -> exists d, d <= M /\ steps V beside w d u.

  Lemma left_few : forall u, In u cells -> l u <= D * S (most (S M)).
  Proof.
    intros u I. destruct (beside u) as [|x r] eqn:B; [rewrite (nobody_leaves_alone k s l R u B); lia|].
    assert (In x (beside u)) as X by (rewrite B; now left). destruct (connected u I) as [d [L S]].
    apply (left_most (Datatypes.S M) u x X). transitivity (most (Datatypes.S d)); [|apply most_le; lia].
    apply counts_most; econstructor; [exact S | now apply mutual].
  Qed.

  Lemma calm_ends : k <= length cells * (D * S (most (S M))).
  Proof.
    transitivity (sum V cells l); [|apply sum_most, left_few]. clear - R closed inside same_spec.
    induction R as [|k s l i v R' IH L B Mi]; [lia|].
    enough (sum V cells l < sum V cells (more l (at_ s i))) by (specialize (IH R'); lia).
    apply sum_lt; [intros; apply more_le, same_spec|]. exists (at_ s i); split; [exact (calm_inside _ _ _ R' i L)|].
    rewrite (more_same V same same_spec); lia.
  Qed.
End Calm.

Section Clause.
  Variables (V : Type) (same : V -> V -> bool) (beside : V -> list V) (cells : list V) (N : nat) (first : V -> nat).
  Variables (D M C0 : nat).
  Hypothesis F : is_floor V same beside cells first D M C0.
  Variable r : rule.
  Hypothesis counting : r <> Once.
  Notation run := (run V same beside cells N first r).
  Notation calm := (calm V same beside N).
  Notation counts := (counts V cells N D M C0). Notation takes := (takes V cells N D M C0).
  Notation calm_for := (calm_for V cells N D M).
  Notation count := (count V). Notation at_ := (at_ V).

  Lemma says_something : forall own there read, 1 <= says r own there read <= S (Nat.max own there).
  Proof. intros own there [|n]; destruct r; cbn; try contradiction; lia. Qed.

  (** How many cells have been entered. *)
  Definition known (f : V -> nat) : nat := length (filter (fun x => negb (f x =? 0)) cells).
  Lemma known_most : forall f, known f <= length cells.
  Proof. clear F; intros f; unfold known; induction cells as [|x l IH]; cbn; [lia|]; destruct (f x =? 0); cbn; lia. Qed.
  Lemma known_le : forall f v n, 1 <= n -> known f <= known (set V same f v n).
  Proof.
    clear F; intros f v n L; unfold known; induction cells as [|x l IH]; cbn [filter]; [lia|]. unfold set at 1.
    destruct (same x v); [destruct (Nat.eqb_spec n 0); [lia|]|]; destruct (f x =? 0); cbn [negb length]; lia.
  Qed.
  Lemma known_lt : forall f v n, 1 <= n -> f v = 0 -> In v cells -> known f < known (set V same f v n).
  Proof.
    intros f v n L Z; unfold known.
    destruct F as [SS _ _ _ _ _]; clear F. induction cells as [|x l IH]; intros I; [destruct I|]. cbn [filter].
    assert (length (filter (fun x => negb (f x =? 0)) l)
      <= length (filter (fun x => negb (set V same f v n x =? 0)) l)).
    { clear - L. induction l as [|y l IH]; cbn [filter]; [lia|]. unfold set at 1.
      destruct (same y v); [destruct (Nat.eqb_spec n 0); [lia|]|]; destruct (f y =? 0); cbn [negb length]; lia. }
    unfold set at 1; destruct (same x v) eqn:E.
    - apply SS in E; subst x; rewrite Z. destruct (Nat.eqb_spec n 0); cbn [negb length Nat.eqb]; lia.
    - destruct I as [->|I]; [rewrite (proj2 (SS v v) eq_refl) in E; discriminate|].
      specialize (IH I). destruct (f x =? 0); cbn [negb length]; lia.
  Qed.

  Lemma no_one_missed : forall missed l (x : V), existsb missed l = false -> In x l -> missed x = false.
  Proof.
    intros missed l x E I; destruct (missed x) eqn:X; [|reflexivity].
    rewrite <- E; symmetry; apply existsb_exists; eauto.
  Qed.

  Lemma run_inside : forall m k s, run m k s -> forall i, i < N -> In (at_ s i) cells.
  Proof.
    intros m k s R; induction R as [p I | m k s i missed v R IH L B Mi]; [exact I|]. intros j J; cbn; unfold put.
    destruct (j =? i); [apply (closed _ _ _ _ _ _ _ _ F (at_ s i)); auto | auto].
  Qed.

  (** As long as a cell is not entered, all since the last sensor that was missed or placed is calm. *)
  Lemma stages : forall w, In w cells -> forall m k s, run m k s -> count s w = 0 ->
    exists j k0 s0 l, j <= m + known (count s) /\ k0 <= takes j /\ (forall u, count s0 u <= counts j)
      /\ (forall i, i < N -> In (at_ s0 i) cells) /\ calm s0 (k - k0) s l /\ k0 <= k.
  Proof.
    intros w Iw m k s R; induction R as [p I | m k s i missed v R IH L B Mi]; intros W.
    { exists 0, 0, {| Ants.count := first; Ants.at_ := p |}, (fun _ => 0). cbn [Nat.add Ants.count].
      repeat split; auto using Nat.le_0_l; [apply F | constructor]. }
    cbn [Ants.count enter] in *. pose proof (says_something (count s (at_ s i)) (count s v) (reads V missed s v)) as Y.
    set (n := says r (count s (at_ s i)) (count s v) (reads V missed s v)) in *.
    pose proof F as [SS Mu Cl Fe Co Sm].
    assert (count s w = 0) as W'.
    { unfold set in W; destruct (same w v); [lia | exact W]. }
    destruct (IH W') as [j [k0 [s0 [l [J [K0 [C [P [Q Z]]]]]]]]]; clear IH.
    pose proof (known_le (count s) v n ltac:(lia)) as KL.
    assert (In v cells) as Iv by (eapply Cl; [eapply run_inside; eauto | exact B]).
    pose proof (calm_ends V same beside cells N D (counts j) SS Mu Cl Fe s0 C P (k - k0) s l w Q W' M
      ltac:(intros; now apply Co)) as T; fold (calm_for (counts j)) in T.
    assert (forall u, count s u <= counts j + calm_for (counts j)) as CS
      by (intros u; pose proof (calm_counts V same beside N (counts j) SS s0 C _ _ _ Q u); lia).
    destruct (existsb missed (beside (at_ s i))) eqn:E; [|destruct (Nat.eq_dec (count s v) 0) as [U|U]].
    3: { (* calm *)
      exists j, k0, s0, (more V same l (at_ s i)). repeat split; auto; try lia.
      replace (S k - k0) with (S (k - k0)) by lia.
      assert (forall x, In x (beside (at_ s i)) -> reads V missed s x = count s x) as RD.
      { intros x X; unfold reads; now rewrite (no_one_missed _ _ _ E X). }
      assert (n = S (count s v)) as NS.
      { subst n; rewrite (RD v B). destruct (count s v); [lia|]. destruct r; cbn; auto; contradiction. }
      unfold enter; fold n; rewrite NS. apply calm_act; auto. intros x X; rewrite <- !RD by auto; auto. }
    all: exists (S j), (S k), (enter V same r s i v (reads V missed s v)), (fun _ => 0); rewrite Nat.sub_diag.
    all: repeat split; try apply calm_start; try lia; cbn [Ants.takes Ants.counts]; try lia.
    all: try (intros u; cbn [enter Ants.count]; fold n; unfold set; pose proof (CS u);
      pose proof (CS v); pose proof (CS (at_ s i)); destruct (same u v); lia).
    all: try (intros q Lq; cbn [enter Ants.at_]; unfold put; destruct (q =? i); [exact Iv | eapply run_inside; eauto]).
    pose proof (known_lt (count s) v n ltac:(lia) U Iv); lia.
  Qed.

  Lemma takes_le : forall i j, i <= j -> takes i <= takes j.
  Proof. intros i j L; induction L; [lia|]; cbn [Ants.takes]; lia. Qed.

  Theorem every_cell_is_entered : forall m k s, run m k s -> enough V cells N D M C0 m <= k -> forall w, In w cells ->
    count s w <> 0.
  Proof.
    intros m k s R L w I W; destruct (stages w I m k s R W) as [j [k0 [s0 [l [J [K0 [C [P [Q Z]]]]]]]]].
    pose proof F as [SS Mu Cl Fe Co Sm].
    pose proof (calm_ends V same beside cells N D (counts j) SS Mu Cl Fe s0 C P (k - k0) s l w Q W M
      ltac:(intros; now apply Co)) as T; fold (calm_for (counts j)) in T.
    pose proof (known_most (count s)); unfold enough in L.
    pose proof (takes_le (S j) (S (m + length cells)) ltac:(lia)) as G. cbn [Ants.takes] in G, L. lia.
  Qed.
End Clause.

(** ANTS-1, with a bound on the actions, for each reading of a missed sensor and for the repair. *)
Theorem ANTS_1 : forall V same beside cells N first D M C0, is_floor V same beside cells first D M C0 ->
  forall r, r <> Once -> forall m k s, run V same beside cells N first r m k s -> enough V cells N D M C0 m <= k ->
  forall w, In w cells -> count V s w <> 0.
Proof. intros; eapply every_cell_is_entered; eauto. Qed.

Lemma least_of_some : forall V (read : V -> nat) near, near <> [] ->
  exists v, In v near /\ forall x, In x near -> read v <= read x.
Proof.
  induction near as [|y near IH]; intros E; [contradiction|]. destruct near as [|z near].
  - exists y; split; [now left|]. now intros x [<-|[]].
  - destruct IH as [v [I L]]; [discriminate|]. destruct (le_lt_dec (read y) (read v)) as [Q|Q].
    + exists y; split; [now left|]. intros x [<-|X]; [lia | specialize (L x X); lia].
    + exists v; split; [now right|]. intros x [<-|X]; [lia | now apply L].
Qed.

Lemma first_of_filter : forall V (p : V -> bool) l v, hd_error (filter p l) = Some v ->
  p v = true /\ exists before after, l = before ++ v :: after /\ forall x, In x before -> p x = false.
Proof.
  induction l as [|y l IH]; intros v E; [discriminate|]. cbn in E; destruct (p y) eqn:P.
  - injection E as <-; split; [exact P|]. exists [], l; split; [reflexivity | intros x []].
  - destruct (IH v E) as [Pv [b [a [-> B]]]]; split; [exact Pv|]. exists (y :: b), a; split; [reflexivity|].
    intros x [<-|X]; auto.
Qed.

(** ANTS-2, of an ant whose cell has the neighbours [near] in the order of the compass, and sees all their sensors. It
    stays only where it has none. An entry adds one to what its cell counts, and changes no other cell. *)
Theorem ANTS_2 : forall V same, (forall a b, same a b = true <-> a = b) -> forall (s : state V) i near,
  (least V (count V s) near = None <-> near = [])
  /\ forall v, least V (count V s) near = Some v ->
    (exists before after, near = before ++ v :: after /\ (forall x, In x before -> count V s v < count V s x)
      /\ forall x, In x after -> count V s v <= count V s x)
    /\ forall x, count V (enter V same Lost s i v (reads V (fun _ => false) s v)) x
                 = if same x v then S (count V s x) else count V s x.
Proof.
  intros V same SS s i near; split; [|intros v E; split].
  - split; [|intros ->; reflexivity]. intros E; destruct near as [|y near]; [reflexivity|]; exfalso.
    destruct (least_of_some V (count V s) (y :: near) ltac:(discriminate)) as [v [I L]].
    unfold least in E; destruct (filter _ (y :: near)) as [|z l] eqn:X; [|discriminate].
    assert (In v []) as []; rewrite <- X; apply filter_In; split; [exact I|].
    apply forallb_forall; intros x Ix; now apply Nat.leb_le, L.
  - apply first_of_filter in E; destruct E as [L [b [a [E B]]]]. rewrite forallb_forall in L.
    exists b, a; split; [exact E|]; split.
    + intros x X; specialize (B x X). assert (In x near) as I by (rewrite E; apply in_or_app; now left).
      destruct (le_lt_dec (count V s x) (count V s v)) as [W|W]; [|exact W].
      rewrite <- not_true_iff_false in B; destruct B; apply forallb_forall; intros y Y.
      apply Nat.leb_le; pose proof (proj1 (Nat.leb_le _ _) (L y Y)); lia.
    + intros x X; apply Nat.leb_le, L; rewrite E; apply in_or_app; right; now right.
  - intros x; unfold enter, reads, set; cbn [count]. destruct (same x v) eqn:X; [|reflexivity].
    apply SS in X; subst; now destruct (count V s v).
Qed.

(** ANTS-3: whatever is missed, where a missed sensor stays beside the new one or is counted on. *)
Theorem ANTS_3 : forall V same, (forall a b, same a b = true <-> a = b) -> forall r, r = Beside \/ r = Counted ->
  forall (s : state V) i v missed x, count V s x <= count V (enter V same r s i v (reads V missed s v)) x.
Proof.
  intros V same SS r R s i v missed x; cbn [enter count]; unfold set. destruct (same x v) eqn:X; [|reflexivity].
  apply SS in X; subst; pose proof (Nat.le_max_l (count V s v) 1).
  destruct R as [-> | ->], (reads V missed s v); cbn [says]; lia.
Qed.

(** What is needed: an ant in a row of four cells, 0 to 3, that starts in cell 1. *)
Definition row (c : nat) : list nat := match c with 0 => [1] | 1 => [0; 2] | 2 => [1; 3] | 3 => [2] | _ => [] end.
Definition row_run : rule -> nat -> nat -> state nat -> Prop :=
  run nat Nat.eqb row [0; 1; 2; 3] 1 (fun c => if c =? 1 then 1 else 0).

Ltac walk := first [apply steps_0 | eapply steps_S; [|cbn; left; reflexivity]; walk
  | eapply steps_S; [|cbn; right; left; reflexivity]; walk].
Lemma row_is_floor : is_floor nat Nat.eqb row [0; 1; 2; 3] (fun c => if c =? 1 then 1 else 0) 2 3 1.
Proof.
  split.
  - apply Nat.eqb_eq.
  - intros [|[|[|[|u]]]] v; cbn; intuition; subst; cbn; auto.
  - intros [|[|[|[|u]]]] v; cbn; intuition.
  - intros [|[|[|[|u]]]]; cbn; lia.
  - intros w u W U; exists (Nat.max (u - w) (w - u)). cbn in W, U.
    destruct W as [<-|[<-|[<-|[<-|[]]]]], U as [<-|[<-|[<-|[<-|[]]]]]; cbn; split; try lia; walk.
  - intros [|[|u]]; cbn; lia.
Qed.

Lemma row_act : forall r m k s missed c v, row_run r m k s -> at_ nat s 0 = c -> In v (row c) ->
  (forall x, In x (row c) -> reads nat missed s v <= reads nat missed s x) ->
  row_run r (if existsb missed (row c) then S m else m) (S k) (enter nat Nat.eqb r s 0 v (reads nat missed s v)).
Proof. intros r m k s missed c v R <- B L; apply act; auto. Qed.

Lemma row_start : forall r, row_run r 0 0 {| count := fun c => if c =? 1 then 1 else 0; at_ := fun _ => 1 |}.
Proof. intros r; apply start; cbn; auto. Qed.

(** A sensor that says 1 however often its cell is entered: the ant goes to and fro between cells 2 and 3. *)
Theorem counting_is_needed : forall k, exists s, row_run Once 0 k s /\ count nat s 0 = 0.
Proof.
  enough (forall k, exists s, row_run Once 0 (S k) s /\ count nat s 0 = 0 /\ count nat s 1 = 1 /\ count nat s 2 = 1
    /\ count nat s 3 <= 1 /\ (at_ nat s 0 = 2 \/ at_ nat s 0 = 3)) as H.
  { intros [|k]; [|destruct (H k) as [s [R [C _]]]; eauto].
    eexists; split; [apply row_start | reflexivity]. }
  induction k as [|k [s [R [C0 [C1 [C2 [C3 A]]]]]]].
  - eexists; split; [apply (row_act Once 0 0 _ (fun _ => false) 1 2 (row_start Once) eq_refl)|];
      cbn; intuition; subst; cbn; auto.
  - destruct A as [A|A]; eexists; (split; [apply (row_act Once 0 (S k) s (fun _ => false) _ (5 - at_ nat s 0) R A)|]);
      unfold reads; rewrite ?A; cbn; intuition; subst; auto; lia.
Qed.

(** Sensors that are missed for ever: the ant goes to and fro between cells 1 and 2, whatever the rule. *)
Theorem an_end_of_misses_is_needed : forall r k, exists m s, row_run r m k s /\ count nat s 0 = 0.
Proof.
  intros r k; enough (exists m s, row_run r m k s /\ count nat s 0 = 0 /\ (at_ nat s 0 = 1 \/ at_ nat s 0 = 2))
    by firstorder.
  induction k as [|k [m [s [R [C A]]]]].
  - do 2 eexists; split; [apply row_start | cbn; auto].
  - destruct A as [A|A]; do 2 eexists; (split;
      [apply (row_act r m k s (fun _ => true) _ (3 - at_ nat s 0) R A)|]); unfold reads; rewrite ?A; cbn; auto.
Qed.

Ltac near_by := cbn; intuition; subst; cbn; auto.
(** A new sensor says 1, and what the missed one counted is lost: an ant comes back from cell 2 to cell 1. *)
Theorem published_breaks_ANTS_3 : exists m k s, row_run Lost m k s
  /\ row_run Lost (S m) (S k) (enter nat Nat.eqb Lost s 0 1 0)
  /\ count nat (enter nat Nat.eqb Lost s 0 1 0) 1 < count nat s 1.
Proof.
  pose proof (row_act Lost 0 0 _ (fun _ => false) 1 0 (row_start Lost) eq_refl ltac:(near_by) ltac:(near_by)) as A.
  pose proof (row_act Lost 0 1 _ (fun _ => false) 0 1 A eq_refl ltac:(near_by) ltac:(near_by)) as B.
  pose proof (row_act Lost 0 2 _ (fun _ => false) 1 2 B eq_refl ltac:(near_by) ltac:(near_by)) as C.
  pose proof (row_act Lost 0 3 _ (fun _ => true) 2 1 C eq_refl ltac:(near_by) ltac:(near_by)) as D.
  do 3 eexists; split; [exact C|]; split; [exact D | cbn; auto].
Qed.
