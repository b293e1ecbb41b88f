(** Ants [Ferranti 2009] where no sensor is missed, as a model of the sentences of SPEC.md: an ant goes to a neighbour
    that was entered least. For every number of ants, every finite connected floor, every order of actions and every way
    to settle ties, a run of more actions than a stated number has entered every cell. Nothing ties the model to the
    kernel: the ledger does not speak of it. *)
From Coq Require Import Lia Bool List Arith.
Import ListNotations.

Section Floor.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V).
  (** How many ants, the most neighbours of a cell, the most that a cell counts at first. *)
  Variables (N D C0 : nat) (first : V -> nat).
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis few : forall u, length (beside u) <= D.
  Hypothesis small : forall u, first u <= C0.

  (** How often a cell was entered, where the ants are, and how often a cell was left. *)
  Record state := { entered : V -> nat; at_ : nat -> V; left_ : V -> nat }.
  Definition more (f : V -> nat) (v : V) : V -> nat := fun x => if same x v then S (f x) else f x.
  Definition put (p : nat -> V) (i : nat) (v : V) : nat -> V := fun j => if j =? i then v else p j.

  (** An ant goes to a neighbour that was entered least. *)
  Inductive run : nat -> state -> Prop :=
  | start : forall p, (forall i, i < N -> In (p i) cells) -> run 0 {| entered := first; at_ := p; left_ := fun _ => 0 |}
  | act : forall k s i v, run k s -> i < N -> In v (beside (at_ s i)) -> In v cells ->
      (forall x, In x (beside (at_ s i)) -> entered s v <= entered s x) ->
      run (S k) {| entered := more (entered s) v; at_ := put (at_ s) i v; left_ := more (left_ s) (at_ s i) |}.

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

  Lemma more_same : forall f v, more f v v = S (f v).
  Proof. intros; unfold more; now rewrite (proj2 (same_spec v v) eq_refl). Qed.
  Lemma more_le : forall f v x, f x <= more f v x. Proof. intros; unfold more; destruct (same x v); lia. Qed.

  (** How many ants are in a cell. *)
  Definition here (p : nat -> V) (u : V) : nat := length (filter (fun i => same (p i) u) (seq 0 N)).
  Definition bit (b : bool) : nat := if b then 1 else 0.
  Lemma here_put : forall p i v u, i < N -> here (put p i v) u + bit (same (p i) u) = here p u + bit (same v u).
  Proof.
    intros p i v u L; unfold here. assert (forall n, (n <= i -> length (filter (fun j => same (put p i v j) u) (seq 0 n))
      = length (filter (fun j => same (p j) u) (seq 0 n))) /\ (i < n -> length (filter (fun j => same (put p i v j) u)
      (seq 0 n)) + bit (same (p i) u) = length (filter (fun j => same (p j) u) (seq 0 n)) + bit (same v u))) as H.
    { induction n as [|n [A B]]; [split; [reflexivity | lia]|]. rewrite seq_S, !filter_app, !app_length; cbn [filter Nat.add].
      unfold put at 2 4; destruct (Nat.eqb_spec n i) as [->|E].
      - split; [lia|]; intros _; rewrite A by lia. destruct (same v u), (same (p i) u); cbn; lia.
      - split; intros Q; [rewrite A by lia | assert (i < n) as Z by lia; specialize (B Z)];
          destruct (same (p n) u); cbn; lia. }
    now apply H.
  Qed.

  (** An ant that comes into a cell either stays or leaves. *)
  Lemma balance : forall k s, run k s -> forall u, entered s u <= first u + left_ s u + here (at_ s) u.
  Proof.
    intros k s R; induction R as [p I | k s i v R IH L B Iv M]; intros u; cbn [entered at_ left_]; [lia|].
    specialize (IH u); pose proof (here_put (at_ s) i v u L) as P. unfold more.
    assert (same u v = same v u) as -> by (apply eq_true_iff_eq; rewrite !same_spec; intuition).
    assert (same u (at_ s i) = same (at_ s i) u) as -> by (apply eq_true_iff_eq; rewrite !same_spec; intuition).
    destruct (same v u), (same (at_ s i) u); cbn [bit] in P; lia.
  Qed.

  (** Beside a cell that was entered [K] times at most, each departure goes to a cell that was so, too. *)
  Lemma departures : forall k s, run k s -> forall u x K, In x (beside u) -> entered s x <= K ->
    left_ s u <= sum (beside u) (fun v => Nat.min (entered s v) (S K)).
  Proof.
    intros k s R; induction R as [p I | k s i v R IH L B Iv M]; intros u x K X E; cbn [entered at_ left_] in *; [lia|].
    assert (entered s x <= K) as E' by (pose proof (more_le (entered s) v x); lia).
    specialize (IH u x K X E'). unfold more at 1; destruct (same u (at_ s i)) eqn:U.
    - apply same_spec in U; subst u. specialize (M x X).
      apply Nat.le_lt_trans with (1 := IH); apply sum_lt.
      + intros y; pose proof (more_le (entered s) v y); lia.
      + exists v; split; [exact B|]; rewrite more_same; lia.
    - etransitivity; [exact IH|]; apply sum_le; intros y _; pose proof (more_le (entered s) v y); lia.
  Qed.

  (** The most that a cell counts which is [d] steps from a cell that nobody has entered. *)
  Fixpoint most (d : nat) : nat := match d with O => 0 | S d => C0 + N + D * S (most d) end.
  Lemma most_mono : forall d, most d <= most (S d).
  Proof. induction d as [|d IH]; [apply Nat.le_0_l|]; cbn [most] in *; nia. Qed.
  Lemma most_le : forall d e, d <= e -> most d <= most e.
  Proof. intros d e L; induction L as [|e L IH]; [lia|]; pose proof (most_mono e); lia. Qed.

  Inductive steps (w : V) : nat -> V -> Prop :=
  | steps_0 : steps w 0 w
  | steps_S : forall d u x, steps w d x -> In x (beside u) -> steps w (S d) u.

  Lemma here_most : forall p u, here p u <= N.
  Proof.
    intros p u; unfold here; rewrite <- (seq_length N 0) at 2. generalize (seq 0 N) as l.
    induction l as [|x r IH]; cbn; [lia|]; destruct (same (p x) u); cbn; lia.
  Qed.

  Lemma left_most : forall k s w, run k s -> entered s w = 0 -> forall d u x, In x (beside u) -> entered s x <= most d ->
    left_ s u <= D * S (most d).
  Proof.
    intros k s w R W d u x X E; pose proof (departures k s R u x _ X E) as Y. etransitivity; [exact Y|].
    etransitivity; [apply (sum_most _ _ (S (most d))); intros; lia|]. pose proof (few u); nia.
  Qed.

  Lemma entered_most : forall k s w, run k s -> entered s w = 0 -> forall d u, steps w d u -> entered s u <= most d.
  Proof.
    intros k s w R W d u S; induction S as [|d u x S IH X]; [cbn; lia|].
    pose proof (balance k s R u); pose proof (left_most k s w R W d u x X IH); pose proof (small u).
    pose proof (here_most (at_ s) u); cbn [most]; lia.
  Qed.

  (** All cells are joined, by [M] steps at most. *)
  Variable M : nat.
  Hypothesis connected : forall w u, In w cells -> In u cells -> exists d, d < M /\ steps w (S d) u.

  Theorem every_cell_is_entered : forall k s, run k s -> length cells * (D * S (most M)) < k -> forall w, In w cells ->
    entered s w <> 0.
  Proof.
    intros k s R L w Iw W.
    assert (k <= sum cells (left_ s)) as Sk.
    { clear L W. induction R as [p I | k s i v R IH Li B Iv Mi]; [lia|]; cbn [left_].
      assert (In (at_ s i) cells) as Ic.
      { clear - R Li. induction R as [p I | k s j v R IH Lj B Iv Mi]; cbn [at_]; [auto|].
        unfold put; destruct (i =? j); auto. }
      enough (sum cells (left_ s) < sum cells (more (left_ s) (at_ s i))) by lia.
      apply sum_lt; [intros; apply more_le|]. exists (at_ s i); split; [exact Ic | rewrite more_same; lia]. }
    assert (sum cells (left_ s) <= length cells * (D * S (most M))); [|lia].
    apply sum_most; intros u Iu; destruct (connected w u Iw Iu) as [d [Ld S]]; inversion S as [|d' u' x Sx X]; subst.
    pose proof (entered_most k s w R W d x Sx) as E. apply (left_most k s w R W M u x X).
    pose proof (most_le d M ltac:(lia)); lia.
  Qed.
End Floor.
