(** FRONTIER-3: every run of robots that explore cells by the plain rule ends, for every number of robots, every finite
    graph of cells and every set of obstacles: no run goes on for ever in which everybody acts who is able to act
    throughout, and in which finitely many messages are missed.

    At last nobody learns anything new, nobody arrives, and nobody begins to wait any more. Then robots act in their own
    slots alone, and meet robots that stand: such a one has the same map and is nearer to an unknown cell. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Frontier Explorers.
Import ListNotations.

(** What falls is constant in the end. *)
Lemma constant : forall f : nat -> nat, (forall n, f (S n) <= f n) ->
  (forall t, (forall n, t <= n -> f n = f t) -> False) -> False.
Proof.
  intros f F H.
  assert (forall n m, n <= m -> f m <= f n) as M by (intros n m L; induction L as [|m L IH]; [lia | specialize (F m); lia]).
  assert (forall k n, f n <= k -> False) as G; [|apply (G (f 0) 0); lia].
  induction k as [|k IH]; intros n L; apply (H n); intros m Lm; specialize (M n m Lm);
    destruct (Nat.eq_dec (f m) (f n)) as [E|E]; auto; [lia|]; exfalso; apply (IH m); lia.
Qed.

(** The same from some time on, for each of [n]. *)
Lemma all_in_the_end : forall (P : nat -> nat -> Prop) n, (forall i t u, t <= u -> P i t -> P i u) ->
  (forall i, i < n -> exists t, P i t) -> exists t, forall i, i < n -> P i t.
Proof.
  intros P n Up H; induction n as [|n IH]; [exists 0; lia|]. destruct IH as [t A]; [auto|]. destruct (H n) as [u B]; [lia|].
  exists (t + u); intros i L; destruct (Nat.eq_dec i n) as [->|D]; [apply (Up n u) | apply (Up i t)]; auto; try lia.
  apply A; lia.
Qed.

Lemma total_same : forall n f g, (forall i, i < n -> g i <= f i) -> total n g = total n f -> forall i, i < n -> g i = f i.
Proof.
  induction n as [|n IH]; intros f g L E i I; [lia|]. rewrite !total_S in E.
  assert (total n g <= total n f) as T.
  { clear - L; induction n as [|n IH]; [cbn; lia|]. rewrite !total_S; specialize (L n) as Ln.
    assert (total n g <= total n f) by (apply IH; intros; apply L; lia). lia. }
  specialize (L n) as Ln; destruct (Nat.eq_dec i n) as [->|D]; [lia|].
  apply (IH f g); [intros; apply L; lia | lia | lia].
Qed.
Lemma total_le : forall n f g, (forall i, i < n -> g i <= f i) -> total n g <= total n f.
Proof.
  induction n as [|n IH]; intros f g L; [cbn; lia|]. rewrite !total_S; specialize (IH f g); specialize (L n) as Ln.
  assert (total n g <= total n f) by (apply IH; intros; apply L; lia). lia.
Qed.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool).
  Variable N : nat.
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_cells : forall u v, In v (beside u) -> In v cells.
  Notation world := (world V).
  Notation PLAIN := (PLAIN V same cells beside).
  Notation nearest := (nearest V same cells beside).
  Notation firsts := (firsts V same cells beside).
  Notation far := (far V same cells beside).
  Notation targets := (targets V same cells beside).
  Notation moves := (moves V).

  (** A rule by which robots go as long as they know a way to an unknown cell, and no longer. *)
  Definition lasting (rl : rule V) : Prop :=
    sensible V same cells beside rl /\ forall i r, targets r (place r) = [] -> chooses rl i r = [].
  Variable rl : rule V.
  Notation run := (run V same cells obstacle N rl).
  Notation leads := (leads V same obstacle N rl).
  Notation may_decide := (may_decide V rl).
  Notation may_tick := (may_tick V N rl).
  Notation late := (late V same rl).

  Definition acts (i : nat) (e : event V) : bool :=
    match e with Decides j _ _ _ | Looks j _ _ _ | Arrives j _ => j =? i | Ticks => false end.
  Definition able (w : world) (i : nat) : bool := moves w i || may_decide w i.
  Definition missed (e : event V) : bool :=
    match e with Decides _ _ _ [] | Looks _ [] [] _ | Arrives _ [] | Ticks => false | _ => true end.

  (** A run without an end, in which everybody acts who is able to act throughout, the clock too. *)
  Definition endless (s : nat -> world) (e : nat -> event V) : Prop := run (s 0) /\ forall n, leads (s n) (e n) (s (S n)).
  Definition fair (s : nat -> world) (e : nat -> event V) : Prop :=
    (forall i n, i < N -> exists m, n <= m /\ (acts i (e m) = true \/ able (s m) i = false))
    /\ forall n, exists m, n <= m /\ (e m = Ticks \/ may_tick (s m) = false).

  (** In the end robots go to nearest cells alone. *)
  Definition plain_in_the_end (s : nat -> world) (e : nat -> event V) : Prop :=
    exists t, forall n i v c ms, t <= n -> e n = Decides i v c ms ->
      In c (nearest (robots (s n) i)) /\ In v (firsts (robots (s n) i) c).

  Hypothesis rl_lasting : lasting rl.

  (** ** What a step changes. *)
  Definition longer (r r' : robot V) : Prop :=
    exists x y, explored r' = explored r ++ x /\ blocked r' = blocked r ++ y.
  Lemma longer_self : forall r, longer r r. Proof. intros r; exists [], []; now rewrite !app_nil_r. Qed.
  Lemma longer_same : forall r r', explored r' = explored r -> blocked r' = blocked r -> longer r r'.
  Proof. intros r r' A B; exists [], []; now rewrite !app_nil_r. Qed.
  Lemma longer_hears : forall r q j said, longer r q -> longer r (hears V same q j said).
  Proof.
    intros r q j said [x [y [A B]]]; unfold longer, hears, join; cbn [explored blocked]; rewrite A, B.
    eexists (x ++ _), (y ++ _); now rewrite <- !app_assoc.
  Qed.
  Lemma told_longer : forall f i l (r : robot V), longer r (f i) -> longer r (fold_left (fun r j => hears V same r j (f j)) l (f i)).
  Proof.
    intros f i l r; generalize (f i); induction l as [|k l IH]; intros q L; cbn; [exact L|].
    apply IH; now apply longer_hears.
  Qed.
  Lemma step_longer : forall w e w', leads w e w' -> forall i, i < N -> longer (robots w i) (robots w' i).
  Proof.
    intros w e w' [x [E [A _]]] i I; rewrite <- A by exact I. clear A.
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _); [|discriminate]; injection E as <-; cbn; destruct (claims rl); unfold tells, put;
        destruct (i =? j) eqn:D; cbn [orb]; try (now apply longer_same); try (apply Nat.eqb_eq in D; subst; now apply longer_same).
      destruct (is_in i ms); [now apply longer_same | now apply longer_hears, longer_same].
    - destruct (doing (robots w j)) as [|v|v]; try discriminate. destruct (negb _); [discriminate|].
      destruct (meets _ _ _ _ _ _) as [|k met]; injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots with_robots].
      + destruct (obstacle v); unfold tells, put; destruct (i =? j) eqn:D; cbn [orb]; try (now apply longer_same);
          try (apply Nat.eqb_eq in D; subst).
        * eexists [], _; split; [now rewrite app_nil_r | reflexivity].
        * destruct (is_in i ms); [now apply longer_same | now apply longer_hears, longer_same].
        * destruct (late _ _); now apply longer_same.
      + assert (longer (robots w i) (tells V same (put (robots w) j (becomes V (robots w j) Stands None true)) j ms i)) as L.
        { unfold tells, put; destruct (i =? j) eqn:D; cbn [orb]; [apply Nat.eqb_eq in D; subst; now apply longer_same|].
          destruct (is_in i ms); [now apply longer_same | now apply longer_hears, longer_same]. }
        unfold is_told; unfold put at 1; destruct (i =? j) eqn:D; [|exact L].
        apply Nat.eqb_eq in D; subst j; now apply told_longer.
    - destruct (doing (robots w j)) as [|v|v]; try discriminate. destruct (j <? N); [|discriminate].
      injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn. unfold tells, put.
      destruct (i =? j) eqn:D; cbn [orb]; [apply Nat.eqb_eq in D; subst|].
      + eexists _, []; split; [reflexivity | now rewrite app_nil_r].
      + destruct (is_in i ms); [now apply longer_same | now apply longer_hears, longer_same].
    - destruct (may_tick w); [|discriminate]; injection E as <-; now apply longer_same.
  Qed.

  (** What only a robot itself changes. *)
  Definition self (r : robot V) : V * stance V * bool := (place r, doing r, waits r).
  Lemma self_hears : forall r j said, self (hears V same r j said) = self r. Proof. reflexivity. Qed.
  Lemma self_told : forall (f : nat -> robot V) l r, self (fold_left (fun r j => hears V same r j (f j)) l r) = self r.
  Proof. intros f l; induction l as [|k l IH]; intros r; cbn; [reflexivity | now rewrite IH]. Qed.
  Lemma self_tells : forall f j ms i, self (tells V same f j ms i) = self (f i).
  Proof. intros f j ms i; unfold tells; destruct (_ || _); reflexivity. Qed.

  (** What a step makes of the robot that acts. *)
  Definition outcome (w : world) (e : event V) (i : nat) (x : V * stance V * bool) : Prop :=
    let r := robots w i in
    match e with
    | Decides j v c _ => j = i /\ may_decide w i = true /\ In (v, c) (chooses rl i r) /\ x = (place r, Tries v, waits r)
    | Looks j _ _ _ => j = i /\ exists v, doing r = Tries v
        /\ ((meets V same N w i v = [] /\ x = if obstacle v || late r v then (place r, Stands, false) else (place r, Enters v, false))
            \/ (meets V same N w i v <> [] /\ x = (place r, Stands, true)))
    | Arrives j _ => j = i /\ exists v, doing r = Enters v /\ x = (v, Stands, waits r)
    | Ticks => False
    end.
  Lemma step_self : forall w e w', leads w e w' -> forall i, i < N ->
    (acts i e = false /\ self (robots w' i) = self (robots w i)) \/ (acts i e = true /\ outcome w e i (self (robots w' i))).
  Proof.
    intros w e w' [x [E [A _]]] i I; rewrite <- A by exact I. clear A.
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next acts] in *.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-; cbn [robots with_robots].
      replace (self _) with (self (put (robots w) j (becomes V (robots w j) (Tries v) (Some c) (waits (robots w j))) i))
        by (destruct (claims rl); [now rewrite self_tells | reflexivity]); unfold put.
      destruct (j =? i) eqn:D.
      + apply Nat.eqb_eq in D; subst j; rewrite Nat.eqb_refl; right; split; [reflexivity|].
        rewrite !andb_true_iff in G; destruct G as [[_ G] X]. apply existsb_exists in X; destruct X as [[v' c'] [X Y]].
        cbn in Y; apply andb_true_iff in Y; destruct Y as [Y Z]; apply same_spec in Y, Z; subst v' c'.
        split; [reflexivity|]; auto.
      + rewrite Nat.eqb_sym, D; auto.
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (negb _); [discriminate|].
      destruct (meets V same N w j v) as [|k met] eqn:M; injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots with_robots].
      + assert (forall o l : bool, let r := if o then blocks V same (robots w j) v else if l then turns V (robots w j)
            else becomes V (robots w j) (Enters v) (aim (robots w j)) false in
          self ((if o then tells V same (put (robots w) j r) j ms else put (robots w) j r) i)
          = if i =? j then (if o || l then (place (robots w j), Stands, false) else (place (robots w j), Enters v, false))
            else self (robots w i)) as S.
        { intros [|] [|]; cbn zeta; rewrite ?self_tells; unfold put; destruct (i =? j); reflexivity. }
        rewrite S, (Nat.eqb_sym i j); destruct (j =? i) eqn:D; [|auto]. apply Nat.eqb_eq in D; subst j.
        right; split; [reflexivity|]; split; [reflexivity|]; exists v; auto.
      + assert (forall g, self (is_told V same (tells V same (put (robots w) j (becomes V (robots w j) Stands None true)) j ms) j g i)
          = if i =? j then (place (robots w j), Stands, true) else self (robots w i)) as S.
        { intros g; unfold is_told; unfold put at 1; destruct (i =? j) eqn:D.
          - rewrite self_told, self_tells; unfold put; now rewrite Nat.eqb_refl.
          - rewrite self_tells; unfold put; now rewrite D. }
        rewrite S, (Nat.eqb_sym i j); destruct (j =? i) eqn:D; [|auto]. apply Nat.eqb_eq in D; subst j.
        right; split; [reflexivity|]; split; [reflexivity|]; exists v; split; [exact Do|]; right.
        rewrite M; split; [discriminate | reflexivity].
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (j <? N); [|discriminate].
      injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots]. rewrite self_tells; unfold put.
      rewrite (Nat.eqb_sym i j); destruct (j =? i) eqn:D; [|auto]. apply Nat.eqb_eq in D; subst j.
      right; split; [reflexivity|]; split; [reflexivity|]; exists v; auto.
    - destruct (may_tick w); [|discriminate]; injection E as <-; auto.
  Qed.

  (** What a step makes of the claim of the robot that acts. *)
  Lemma step_aim : forall w e w', leads w e w' -> forall i, i < N -> if acts i e then match e with
      | Decides _ _ c _ => aim (robots w' i) = Some c
      | Looks _ _ _ _ => forall v, doing (robots w i) = Tries v ->
          (meets V same N w i v <> [] /\ aim (robots w' i) = None)
          \/ (meets V same N w i v = [] /\ obstacle v = true /\ In v (blocked (robots w' i)))
          \/ (meets V same N w i v = [] /\ obstacle v = false
              /\ aim (robots w' i) = if late (robots w i) v then None else aim (robots w i))
      | Arrives _ _ => forall v, doing (robots w i) = Enters v -> aim (robots w' i)
          = match aim (robots w i) with Some c => if claims rl && negb (same c v) then Some c else None | None => None end
      | Ticks => True
      end else aim (robots w' i) = aim (robots w i).
  Proof.
    assert (forall f j ms k, aim (tells V same f j ms k) = aim (f k)) as T
      by (intros f j ms k; unfold tells; destruct ((k =? j) || is_in k ms); reflexivity).
    assert (forall (f : nat -> robot V) l r, aim (fold_left (fun r j => hears V same r j (f j)) l r) = aim r) as H
      by (intros f; induction l as [|k l IH]; intros r; cbn; [reflexivity | now rewrite IH]).
    assert (forall f j l k, aim (is_told V same f j l k) = aim (f k)) as To by (intros f j l k; unfold is_told, put;
      destruct (k =? j) eqn:K; [apply Nat.eqb_eq in K; subst; apply H | reflexivity]).
    intros w e w' [x [E [A _]]] i I; rewrite <- A by exact I. clear A.
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next acts] in *.
    - destruct (_ && _); [|discriminate]; injection E as <-; cbn [robots with_robots]. replace (aim _) with (aim (put (robots w) j
        (becomes V (robots w j) (Tries v) (Some c) (waits (robots w j))) i)) by (destruct (claims rl); [now rewrite T | reflexivity]).
      unfold put.
      rewrite (Nat.eqb_sym i j); destruct (j =? i); reflexivity.
    - destruct (doing (robots w j)) as [|v|v] eqn:D; try discriminate. destruct (negb _); [discriminate|].
      destruct (meets V same N w j v) as [|k met] eqn:M; injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots with_robots].
      + assert (forall o l : bool, let r := if o then blocks V same (robots w j) v else if l then turns V (robots w j)
            else becomes V (robots w j) (Enters v) (aim (robots w j)) false in
          aim ((if o then tells V same (put (robots w) j r) j ms else put (robots w) j r) i)
          = if (j =? i) && (o || l) then None else aim (robots w i)) as S.
        { intros [|] [|]; cbn zeta; rewrite ?T; unfold put; rewrite (Nat.eqb_sym i j); destruct (j =? i) eqn:J; try reflexivity.
          apply Nat.eqb_eq in J; now subst. }
        destruct (j =? i) eqn:J; [apply Nat.eqb_eq in J; subst j | now rewrite S].
        intros u U; rewrite D in U; injection U as <-; right. rewrite S; cbn [andb]; destruct (obstacle v); [left | right; auto].
        repeat split; auto. unfold tells; rewrite Nat.eqb_refl; cbn [orb]; unfold put; rewrite Nat.eqb_refl; cbn.
        apply (in_join V same cells beside same_spec beside_cells); cbn; auto.
      + rewrite To, T; unfold put; rewrite (Nat.eqb_sym i j); destruct (j =? i) eqn:J; [|reflexivity].
        apply Nat.eqb_eq in J; subst j; intros u U; rewrite D in U; injection U as <-; left; rewrite M; split; [discriminate | reflexivity].
    - destruct (doing (robots w j)) as [|v|v] eqn:D; try discriminate. destruct (j <? N); [|discriminate].
      injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots]. rewrite T; unfold put.
      rewrite (Nat.eqb_sym i j); destruct (j =? i) eqn:J; [|reflexivity]. apply Nat.eqb_eq in J; subst j.
      intros u U; rewrite D in U; now injection U as <-.
    - destruct (may_tick w); [|discriminate]; injection E as <-; reflexivity.
  Qed.

  (** Maps have each cell once. *)
  Definition fits (r : robot V) : Prop :=
    (NoDup (explored r) /\ incl (explored r) cells) /\ NoDup (blocked r) /\ incl (blocked r) cells.
  Lemma fits_join : forall l m, NoDup l /\ incl l cells -> NoDup m /\ incl m cells ->
    NoDup (join V same l m) /\ incl (join V same l m) cells.
  Proof.
    intros l m [A B] [C D]; split; unfold join.
    - induction m as [|v m IH]; cbn; [now rewrite app_nil_r|]. inversion C; subst.
      assert (incl m cells) as Dm by (intros x X; apply D; now right).
      destruct (has V same l v) eqn:H; cbn; [now apply IH|].
      apply NoDup_Add with (a := v) (l := l ++ filter (fun v => negb (has V same l v)) m); [apply Add_app|].
      split; [now apply IH|]. intros I; apply in_app_or in I; destruct I as [I|I].
      + apply (has_in V same cells beside same_spec beside_cells) in I; congruence.
      + apply filter_In in I; tauto.
    - intros x X; apply in_app_or in X; destruct X as [X|X]; [auto | apply filter_In in X; apply D; tauto].
  Qed.
  Lemma fits_hears : forall r j q, fits r -> fits q -> fits (hears V same r j q).
  Proof. intros r j q [A B] [C D]; split; cbn; now apply fits_join. Qed.
  Lemma fits_told : forall (f : nat -> robot V) l r, (forall j, In j l -> fits (f j)) -> fits r ->
    fits (fold_left (fun r j => hears V same r j (f j)) l r).
  Proof.
    intros f l; induction l as [|k l IH]; intros r L R; cbn; [exact R|]. apply IH; [intros; apply L; now right|].
    apply fits_hears; [exact R | apply L; now left].
  Qed.
  Lemma fits_one : forall v, In v cells -> NoDup [v] /\ incl [v] cells.
  Proof. intros v I; split; [repeat constructor; auto | intros x [<-|[]]; exact I]. Qed.
  Lemma fits_always : forall w, run w -> forall i, i < N -> fits (robots w i).
  Proof.
    intros w R; induction R as [start w [S1 S2] [A _] | w e w' R IH [x [E [A _]]]]; intros i I; rewrite <- A by exact I.
    { split; cbn; [|split; [constructor | intros x []]]. split.
      - apply NoDup_nth with (d := start 0); rewrite map_length, seq_length; intros j k J K E.
        rewrite (map_nth start), (map_nth start), !seq_nth in E by assumption; now apply S2.
      - intros v J; apply in_map_iff in J; destruct J as [j [<- J]]; apply in_seq in J; apply S1; lia. }
    clear A. assert (forall j, j < N -> match doing (robots w j) with Stands => True | Tries v | Enters v => In v cells end) as Cell.
    { intros j J; destruct (placed_always V same cells beside obstacle N same_spec beside_cells _ w
        (proj1 rl_lasting) R j J) as [_ [_ P]]; destruct (doing _); eauto. }
    assert (forall (f : nat -> robot V) j ms, (forall k, k < N -> fits (f k)) -> j < N -> forall k, k < N -> fits (tells V same f j ms k)) as T
      by (intros f j ms F J k K; unfold tells; destruct (_ || _); [auto | apply fits_hears; auto]).
    assert (forall (f : nat -> robot V) j r, (forall k, k < N -> fits (f k)) -> fits r -> forall k, k < N -> fits (put f j r k)) as P
      by (intros f j r F Fr k K; unfold put; destruct (k =? j); auto).
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-; cbn.
      rewrite !andb_true_iff, Nat.ltb_lt in G; destruct G as [[G _] _].
      assert (forall k, k < N -> fits (put (robots w) j (becomes V (robots w j) (Tries v) (Some c) (waits (robots w j))) k)) as Q
        by (apply P; [exact IH | apply (IH j G)]).
      destruct (claims rl); [now apply T | now apply Q].
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (j <? N) eqn:J; [|discriminate].
      destruct (sl <? N); [|discriminate]; cbn [andb negb] in E; apply Nat.ltb_lt in J; specialize (Cell j J); rewrite Do in Cell.
      destruct (meets V same N w j v) as [|k met] eqn:M; [|rewrite <- M in E]; injection E as <-;
        rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots with_robots].
      + destruct (obstacle v); [apply T; auto|]; apply P; auto; try (destruct (late _ _); apply (IH j J)).
        destruct (IH j J) as [B C]; split; [exact B|]; cbn; apply fits_join; [exact C | now apply fits_one].
      + assert (forall k, k < N -> fits (tells V same (put (robots w) j (becomes V (robots w j) Stands None true)) j ms k)) as Q
          by (apply T; [apply P; [exact IH | apply (IH j J)] | exact J]).
        apply P; [exact Q | | exact I]. apply fits_told; [|now apply Q].
        intros k' K; apply Q; apply filter_In in K; destruct K as [K _]; eapply meets_robots; eauto.
    - destruct (doing (robots w j)) as [|v|v] eqn:Do; try discriminate. destruct (j <? N) eqn:J; [|discriminate].
      apply Nat.ltb_lt in J; specialize (Cell j J); rewrite Do in Cell; injection E as <-.
      rewrite (proj1 (settle_robots _ _ _ _)); cbn. apply T; auto; apply P; auto.
      destruct (IH j J) as [B C]; split; [|exact C]; cbn; apply fits_join; [exact B | now apply fits_one].
    - destruct (may_tick w); [|discriminate]; injection E as <-; now apply IH.
  Qed.

  (** Robots enter free cells. *)
  Lemma step_been : forall w e w', leads w e w' ->
    been w' = been w \/ exists i v, i < N /\ doing (robots w i) = Enters v /\ been w' = v :: been w.
  Proof.
    intros w e w' [x [E [_ [B _]]]]; rewrite <- B; destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _); [|discriminate]; injection E as <-; auto.
    - destruct (doing (robots w j)); try discriminate. destruct (negb _); [discriminate|].
      destruct (meets _ _ _ _ _ _); injection E as <-; rewrite (proj2 (settle_robots _ _ _ _)); auto.
    - destruct (doing (robots w j)) as [|v|v] eqn:D; try discriminate. destruct (j <? N) eqn:J; [|discriminate].
      injection E as <-; rewrite (proj2 (settle_robots _ _ _ _)); right; exists j, v; apply Nat.ltb_lt in J; auto.
    - destruct (may_tick w); [|discriminate]; injection E as <-; auto.
  Qed.
  Lemma free_always : forall w, run w -> (forall v, In v (been w) -> obstacle v = false)
    /\ forall i v, i < N -> doing (robots w i) = Enters v -> obstacle v = false.
  Proof.
    intros w R; induction R as [start w [S _] [A [B _]] | w e w' R [IH1 IH2] St].
    - rewrite <- B; split; [|intros i v I; rewrite <- A by exact I; discriminate].
      intros v I; apply in_map_iff in I; destruct I as [i [<- I]]; apply in_seq in I; apply S; lia.
    - split.
      + destruct (step_been _ _ _ St) as [->|[i [v [I [D ->]]]]]; [exact IH1|]. intros x [<-|X]; eauto.
      + intros i v I D; destruct (step_self _ _ _ St i I) as [[_ E]|[_ O]].
        * unfold self in E; injection E as _ E _; rewrite D in E; eauto.
        * unfold self in O; rewrite D in O; destruct e as [j u c ms|j ms un sl|j ms|]; cbn in O; [| | |destruct O].
          -- destruct O as [_ [_ [_ O]]]; discriminate.
          -- destruct O as [_ [u [_ [[_ O]|[_ O]]]]]; [destruct (obstacle u) eqn:Ob; [|destruct (late _ _)]|]; try discriminate.
             now injection O as _ ->.
          -- destruct O as [_ [u [_ O]]]; discriminate.
  Qed.

  (** What a step makes of the slot while a robot waits, before and after it. *)
  Lemma step_slot : forall w e w', leads w e w' -> some N (waiting V rl w) = true -> some N (waiting V rl w') = true ->
    match e with
    | Decides i _ _ _ => i < N /\ may_decide w i = true /\ slot w' = slot w /\ tried w' = tried w
    | Looks i _ _ _ => i < N /\ moves w i = true
        /\ slot w' = slot w /\ (meets V same N w i (match doing (robots w i) with Tries v => v | Stands | Enters _ => place (robots w i) end) <> [] ->
          tried w' = tried w || (slot w =? i))
    | Arrives i _ => True
    | Ticks => may_tick w = true /\ slot w' = (slot w + 1) mod N /\ tried w' = false
    end.
  Proof.
    intros w e w' [x [E [A [_ [S [_ T]]]]]] W W'; rewrite <- S, <- T.
    assert (some N (waiting V rl x) = true) as Wx.
    { apply some_spec in W'; destruct W' as [i [I X]]; apply some_spec; exists i; split; [exact I|].
      unfold waiting, would in *; now rewrite A. }
    assert (forall y, settle V N rl y = x -> slot x = slot y /\ tried x = tried y) as St.
    { intros y Y; assert (some N (waiting V rl y) = true) as Wy.
      { assert (robots y = robots x) as Ry by (rewrite <- Y; now rewrite (proj1 (settle_robots _ _ _ _))).
        apply some_spec in Wx; destruct Wx as [i [I X]]; apply some_spec; exists i; split; [exact I|].
        unfold waiting, would in *; now rewrite Ry. }
      unfold settle in Y; rewrite Wy in Y; now subst. }
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E; auto.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-. rewrite !andb_true_iff, Nat.ltb_lt in G; tauto.
    - unfold Explorers.moves; destruct (doing (robots w j)) as [|v|v]; try discriminate.
      destruct (j <? N) eqn:J; [|discriminate]; apply Nat.ltb_lt in J. destruct (negb _); [discriminate|].
      destruct (meets V same N w j v) as [|k met]; injection E as E; apply St in E; cbn [slot tried with_robots] in E;
        rewrite ?W in E; destruct E as [-> ->]; repeat split; auto; congruence.
    - destruct (may_tick w) eqn:M; [|discriminate]; injection E as <-; auto.
  Qed.
  (** Two robots that meet have the same map then, if they hear each other. *)
  Lemma step_meets : forall w i sl w' v k, leads w (Looks i [] [] sl) w' -> i < N -> doing (robots w i) = Tries v ->
    In k (meets V same N w i v) -> forall c,
    (In c (explored (robots w k)) \/ In c (explored (robots w i)) ->
      In c (explored (robots w' i)) /\ In c (explored (robots w' k)))
    /\ (In c (blocked (robots w k)) \/ In c (blocked (robots w i)) ->
      In c (blocked (robots w' i)) /\ In c (blocked (robots w' k))).
  Proof.
    intros w i sl w' v k [x [E [A _]]] I D M c. assert (k < N) as K by (eapply meets_robots; eauto).
    rewrite <- !A by assumption; clear A; cbn [next] in E; rewrite D in E; destruct (negb _); [discriminate|].
    destruct (meets V same N w i v) as [|m met] eqn:Me; [destruct M|]. injection E as <-.
    rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots].
    assert (k <> i) as Ne by (rewrite <- Me in M; apply filter_In in M; destruct M as [_ M]; apply andb_true_iff in M;
      destruct M as [M _]; now apply negb_true_iff, Nat.eqb_neq in M).
    set (f := tells V same (put (robots w) i (becomes V (robots w i) Stands None true)) i []).
    assert (explored (f k) = join V same (explored (robots w k)) (explored (robots w i))
      /\ blocked (f k) = join V same (blocked (robots w k)) (blocked (robots w i))) as [Fk Fk'].
    { apply Nat.eqb_neq in Ne; unfold f, tells, put, is_in; rewrite Ne, Nat.eqb_refl; cbn [orb existsb]; auto. }
    assert (f i = becomes V (robots w i) Stands None true) as Fi by (unfold f, tells, put; now rewrite Nat.eqb_refl).
    assert (forall l r, (forall c, In c (explored r) -> In c (explored (fold_left (fun r j => hears V same r j (f j)) l r)))
      /\ forall c, In c (blocked r) -> In c (blocked (fold_left (fun r j => hears V same r j (f j)) l r))) as Up.
    { induction l as [|j l IHl]; intros r; cbn; [auto|]. destruct (IHl (hears V same r j (f j))) as [U1 U2].
      split; intros y Y; [apply U1 | apply U2]; cbn; apply in_or_app; auto. }
    assert (forall l r, In k l -> (forall c, In c (explored (f k)) -> In c (explored (fold_left (fun r j => hears V same r j (f j)) l r)))
      /\ forall c, In c (blocked (f k)) -> In c (blocked (fold_left (fun r j => hears V same r j (f j)) l r))) as Hear.
    { induction l as [|j l IHl]; intros r J; [destruct J|]; cbn; destruct J as [->|J]; [|now apply IHl].
      destruct (Up l (hears V same r k (f k))) as [U1 U2]; split; intros y Y; [apply U1 | apply U2]; cbn;
        apply (in_join V same cells beside same_spec beside_cells); auto. }
    set (l := m :: filter (fun _ => true) met).
    assert (In k l) as Fl by (destruct M as [->|M]; [now left | right; apply filter_In; auto]).
    assert (explored (is_told V same f i l k) = explored (f k) /\ blocked (is_told V same f i l k) = blocked (f k)) as [-> ->]
      by (apply Nat.eqb_neq in Ne; unfold is_told, put; now rewrite Ne).
    unfold is_told, put at 1 2; rewrite Nat.eqb_refl. destruct (Hear _ (f i) Fl) as [H1 H2].
    rewrite Fk, Fk' in *. split; intros C; (split; [|apply (in_join V same cells beside same_spec beside_cells); exact C]);
      [apply H1 | apply H2]; apply (in_join V same cells beside same_spec beside_cells); exact C.
  Qed.

  (** ** A run without an end. *)
  Section Endless.
    Variables (s : nat -> world) (e : nat -> event V).
    Hypothesis goes_on : endless s e.
    Hypothesis is_fair : fair s e.
    Definition at_ (n i : nat) : robot V := robots (s n) i.

    Lemma runs : forall n, run (s n).
    Proof. induction n as [|n IH]; [apply goes_on|]. eapply run_step; [exact IH | apply goes_on]. Qed.
    Lemma self_step : forall n i, i < N -> (acts i (e n) = false /\ self (at_ (S n) i) = self (at_ n i))
      \/ (acts i (e n) = true /\ outcome (s n) (e n) i (self (at_ (S n) i))).
    Proof. intros n i I; apply step_self; [apply goes_on | exact I]. Qed.

    (** Until a robot acts it is as it was. *)
    Lemma until : forall i n k, i < N ->
      (exists m, n <= m < n + k /\ acts i (e m) = true /\ self (at_ m i) = self (at_ n i))
      \/ self (at_ (n + k) i) = self (at_ n i).
    Proof.
      intros i n k I; induction k as [|k [[m [L H]]|IH]]; [right; now rewrite Nat.add_0_r | left; exists m; split; [lia | exact H] |].
      rewrite Nat.add_succ_r; destruct (self_step (n + k) i I) as [[_ E]|[A _]]; [right; congruence|].
      left; exists (n + k); split; [lia | auto].
    Qed.
    Lemma flier_acts : forall i n, i < N -> moves (s n) i = true ->
      exists m, n <= m /\ acts i (e m) = true /\ self (at_ m i) = self (at_ n i).
    Proof.
      intros i n I M; destruct is_fair as [F _]; destruct (F i n I) as [m [L H]].
      destruct (until i n (m - n) I) as [[k [Lk K]]|E]; [exists k; split; [lia | exact K]|].
      replace (n + (m - n)) with m in E by lia. destruct H as [A|A]; [exists m; auto|].
      exfalso; unfold able in A; apply orb_false_iff in A; destruct A as [A _].
      unfold Explorers.moves, self, at_ in *; injection E as _ E _; now rewrite E, M in A.
    Qed.
    Definition flying (n i : nat) : Prop := doing (at_ n i) <> Stands.
    Lemma flying_moves : forall n i, flying n i <-> moves (s n) i = true.
    Proof. intros n i; unfold flying, Explorers.moves, at_; destruct (doing (robots (s n) i)); split; congruence. Qed.
    Lemma self_eq : forall r r', self r = self r' -> place r = place r' /\ doing r = doing r' /\ waits r = waits r'.
    Proof. unfold self; intros r r' E; injection E; auto. Qed.

    Lemma lands_or_stays : forall i n, i < N -> exists m, n <= m /\ doing (at_ m i) = Stands.
    Proof.
      intros i n I.
      assert (forall n v, doing (at_ n i) = Enters v -> exists m, n <= m /\ doing (at_ m i) = Stands) as En.
      { intros k v D; destruct (flier_acts i k I) as [m [L [A Sm]]]; [apply flying_moves; unfold flying; rewrite D; discriminate|].
        apply self_eq in Sm; destruct Sm as [_ [Dm _]]; rewrite D in Dm.
        destruct (self_step m i I) as [[X _]|[_ O]]; [congruence|]. exists (S m); split; [lia|]. unfold at_ in *.
        destruct (e m) as [j u c ms|j ms un sl|j ms|]; cbn in O; [| | |destruct O].
        - destruct O as [_ [O _]]; unfold Explorers.may_decide, Explorers.moves in O; now rewrite Dm in O.
        - destruct O as [_ [u [O _]]]; congruence.
        - destruct O as [_ [u [_ O]]]; unfold self in O; injection O; auto. }
      destruct (doing (at_ n i)) as [|v|v] eqn:D; [exists n; auto | | now apply (En n v)].
      destruct (flier_acts i n I) as [m [L [A Sm]]]; [apply flying_moves; unfold flying; rewrite D; discriminate|].
      apply self_eq in Sm; destruct Sm as [_ [Dm _]]; rewrite D in Dm.
      destruct (self_step m i I) as [[X _]|[_ O]]; [congruence|]. unfold at_ in Dm.
      assert (doing (at_ (S m) i) = Stands \/ exists u, doing (at_ (S m) i) = Enters u) as [H|[u H]].
      { unfold at_; destruct (e m) as [j u c ms|j ms un sl|j ms|]; cbn in O; [| | |destruct O].
        - destruct O as [_ [O _]]; unfold Explorers.may_decide, Explorers.moves in O; now rewrite Dm in O.
        - destruct O as [_ [u [_ [[_ O]|[_ O]]]]]; unfold self in O; [destruct (_ || _)|]; injection O; eauto.
        - destruct O as [_ [u [O _]]]; congruence. }
      - exists (S m); split; [lia | exact H].
      - destruct (En _ _ H) as [k [Lk K]]; exists k; split; [lia | exact K].
    Qed.

    (** *** Nobody learns anything new. *)
    Definition learnt (n : nat) : nat :=
      N * (2 * length cells) - total N (fun i => length (explored (at_ n i)) + length (blocked (at_ n i))).
    Definition known (t : nat) : Prop := forall n i, t <= n -> i < N ->
      explored (at_ n i) = explored (at_ t i) /\ blocked (at_ n i) = blocked (at_ t i).
    Lemma longer_lengths : forall n i, i < N ->
      length (explored (at_ n i)) <= length (explored (at_ (S n) i)) /\ length (blocked (at_ n i)) <= length (blocked (at_ (S n) i)).
    Proof.
      intros n i I; destruct (step_longer _ _ _ (proj2 goes_on n) i I) as [x [y [A B]]]; unfold at_; rewrite A, B, !app_length; lia.
    Qed.
    Lemma learnt_most : forall n i, i < N -> length (explored (at_ n i)) + length (blocked (at_ n i)) <= 2 * length cells.
    Proof.
      intros n i I; destruct (fits_always (s n) (runs n) i I) as [[A B] [C D]].
      pose proof (NoDup_incl_length A B); pose proof (NoDup_incl_length C D); unfold at_; lia.
    Qed.
    Lemma learnt_falls : forall n, learnt (S n) <= learnt n.
    Proof.
      intros n; unfold learnt.
      assert (total N (fun i => length (explored (at_ n i)) + length (blocked (at_ n i)))
        <= total N (fun i => length (explored (at_ (S n) i)) + length (blocked (at_ (S n) i)))); [|lia].
      apply total_le; intros i I; destruct (longer_lengths n i I); lia.
    Qed.
    Lemma learnt_same : forall t, (forall n, t <= n -> learnt n = learnt t) -> known t.
    Proof.
      intros t H n i L I; induction L as [|n L [IHa IHb]]; [auto|]. rewrite <- IHa, <- IHb.
      assert (learnt (S n) = learnt n) as E by (rewrite (H (S n)), (H n); lia). unfold learnt in E.
      pose proof (total_most N (fun i => length (explored (at_ n i)) + length (blocked (at_ n i))) (2 * length cells)
        (fun i I => learnt_most n i I)) as M1.
      pose proof (total_most N (fun i => length (explored (at_ (S n) i)) + length (blocked (at_ (S n) i))) (2 * length cells)
        (fun i I => learnt_most (S n) i I)) as M2.
      pose proof (total_same N (fun i => length (explored (at_ (S n) i)) + length (blocked (at_ (S n) i)))
        (fun i => length (explored (at_ n i)) + length (blocked (at_ n i)))
        (fun i I => ltac:(destruct (longer_lengths n i I); lia)) ltac:(cbn beta in *; lia) i I) as Eq. cbn beta in Eq.
      destruct (step_longer _ _ _ (proj2 goes_on n) i I) as [x [y [A B]]]; unfold at_ in *.
      rewrite A, B, !app_length in Eq; assert (x = [] /\ y = []) as [-> ->]
        by (split; [destruct x | destruct y]; cbn in Eq; auto; lia).
      now rewrite A, B, !app_nil_r.
    Qed.

    (** *** Nobody arrives. *)
    Definition alike_maps (r r' : robot V) : Prop := explored r = explored r' /\ blocked r = blocked r' /\ place r = place r'.
    Lemma nearest_alike : forall r r', alike_maps r r' -> nearest r = nearest r' /\ (forall c, firsts r c = firsts r' c).
    Proof.
      intros r r' [A [B C]]; unfold Explorers.nearest, Explorers.firsts, Explorers.targets; rewrite A, B, C; auto.
    Qed.
    Lemma would_iff : forall n i, would V rl (s n) i = true <-> targets (at_ n i) (place (at_ n i)) <> [].
    Proof.
      intros n i; unfold would, at_; destruct rl_lasting as [[_ S] L]; specialize (S i (robots (s n) i)).
      specialize (L i (robots (s n) i)); destruct (chooses rl i (robots (s n) i)); [split; [discriminate | intros H; exfalso; auto]|].
      split; [intros _ H; now apply L in H | reflexivity].
    Qed.
    Lemma would_alike : forall n m i, alike_maps (at_ n i) (at_ m i) -> would V rl (s n) i = would V rl (s m) i.
    Proof.
      intros n m i [A [B C]]; apply eq_true_iff_eq; rewrite !would_iff; unfold Explorers.targets; now rewrite A, B, C.
    Qed.

    (** A robot under way is on a shortest way to a nearest unknown cell, by what it knows. *)
    Definition aligned (n i : nat) : Prop :=
      match doing (at_ n i) with
      | Stands => True
      | Tries v | Enters v => exists c, In c (nearest (at_ n i)) /\ In v (firsts (at_ n i) c)
      end.
    Variable plain_from : nat.
    Hypothesis is_plain : forall n i v c ms, plain_from <= n -> e n = Decides i v c ms ->
      In c (nearest (at_ n i)) /\ In v (firsts (at_ n i) c).
    Lemma aligned_step : forall t n i, known t -> t <= n -> plain_from <= n -> i < N -> aligned n i -> aligned (S n) i.
    Proof.
      intros t n i K L Pf I A; destruct (K n i L I) as [K1 K2], (K (S n) i ltac:(lia) I) as [K3 K4].
      assert (forall r, place (at_ (S n) i) = place r -> explored r = explored (at_ n i) -> blocked r = blocked (at_ n i) ->
        nearest (at_ (S n) i) = nearest r /\ forall c, firsts (at_ (S n) i) c = firsts r c) as Al
        by (intros r P E B; apply nearest_alike; repeat split; congruence).
      unfold aligned in *; destruct (self_step n i I) as [[_ E]|[_ O]].
      - apply self_eq in E; destruct E as [P [D _]]; rewrite D; destruct (Al _ P eq_refl eq_refl) as [-> F].
        destruct (doing (at_ n i)); auto; destruct A as [c [C1 C2]]; exists c; now rewrite F.
      - remember (self (at_ (S n) i)) as x eqn:X; unfold self in X.
        destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:Ev; cbn in O; [| | |destruct O].
        + destruct O as [-> [_ [_ E]]]; rewrite E in X; injection X as P D _; rewrite <- D.
          destruct (Al (at_ n i) (eq_sym P) eq_refl eq_refl) as [-> F]; exists c; rewrite F; now apply (is_plain n i v c ms).
        + destruct O as [_ [v [D [[_ O]|[_ O]]]]]; rewrite O in X; [destruct (_ || _)|]; injection X as P D' _; rewrite <- D'; auto.
          unfold at_ in A at 1; rewrite D in A; destruct (Al (at_ n i) (eq_sym P) eq_refl eq_refl) as [-> F].
          destruct A as [c [C1 C2]]; exists c; now rewrite F.
        + destruct O as [_ [v [_ O]]]; rewrite O in X; injection X as _ D _; now rewrite <- D.
    Qed.

    (** A robot under way has not claimed what it knows to be explored. *)
    Definition fresh (n i : nat) : Prop :=
      doing (at_ n i) <> Stands -> forall a, aim (at_ n i) = Some a -> ~ In a (explored (at_ n i)).
    Lemma fresh_step : forall t n i, known t -> t <= n -> plain_from <= n -> i < N -> fresh n i -> fresh (S n) i.
    Proof.
      intros t n i K L Pf I F Fl a; destruct (K n i L I) as [K1 _], (K (S n) i ltac:(lia) I) as [K2 _].
      rewrite K2, <- K1. pose proof (step_aim _ _ _ (proj2 goes_on n) i I) as A; fold (at_ n i) (at_ (S n) i) in A.
      destruct (self_step n i I) as [[X S]|[X O]]; rewrite X in A.
      - apply self_eq in S; destruct S as [_ [S _]]; rewrite A; apply F; congruence.
      - remember (self (at_ (S n) i)) as x eqn:Y; unfold self in Y.
        destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:Ev; cbn in O; [| | |destruct O].
        + destruct O as [-> _]; rewrite A; intros E; injection E as <-.
          destruct (is_plain n i v c ms Pf Ev) as [Ne _]; apply (nearest_spec V same cells beside) in Ne; auto.
          destruct Ne as [T _]; apply (targets_spec V same cells beside) in T; auto; tauto.
        + destruct O as [-> [v [D O]]]; specialize (A v D). assert (doing (at_ n i) <> Stands) as Fn by (unfold at_; rewrite D; discriminate).
          destruct O as [[Me O]|[Me O]]; rewrite O in Y; [|injection Y as _ Y _; congruence].
          destruct A as [[A _]|[[_ [Ob _]]|[_ [Ob A]]]]; [congruence | rewrite Ob in Y; injection Y as _ Y _; congruence|].
          rewrite A; destruct (late (at_ n i) v); [discriminate | now apply F].
        + destruct O as [-> [v [D O]]]; rewrite O in Y; injection Y as _ Y _; congruence.
    Qed.

    Lemma under_way_in_the_end : forall t, known t -> plain_from <= t ->
      exists u, t <= u /\ forall n i, u <= n -> i < N -> aligned n i /\ fresh n i.
    Proof.
      intros t K Pf; destruct (all_in_the_end (fun i u => t <= u /\ forall n, u <= n -> aligned n i /\ fresh n i) N) as [u H].
      - intros i a b L [A B]; split; [lia | intros; apply B; lia].
      - intros i I; destruct (lands_or_stays i t I) as [m [L D]]; exists m; split; [exact L|]; intros n Ln.
        induction Ln as [|n Ln [A F]]; [split; [unfold aligned; now rewrite D | intros Fl; congruence]|].
        split; [eapply aligned_step; eauto; lia | eapply fresh_step; eauto; lia].
      - exists (t + u); split; [lia|]; intros n i L I; apply (proj2 (H i I)); lia.
    Qed.

    Definition near (r : robot V) : nat := match nearest r with [] => 0 | c :: _ => far (explored r) (place r) c end.
    Lemma nearest_iff : forall r c, In c (nearest r) <-> In c (targets r (place r)) /\ forall d,
      In d (targets r (place r)) -> far (explored r) (place r) c <= far (explored r) (place r) d.
    Proof. apply nearest_spec; assumption. Qed.
    Lemma near_spec : forall r c, In c (nearest r) -> near r = far (explored r) (place r) c.
    Proof.
      intros r c I; unfold near; destruct (nearest r) as [|d l] eqn:E; [destruct I|].
      assert (In d (nearest r)) as J by (rewrite E; cbn; auto). rewrite <- E in I.
      apply nearest_iff in I; apply nearest_iff in J; destruct I as [I M], J as [J M']; apply Nat.le_antisymm; auto.
    Qed.
    Lemma near_most : forall r c, In c (targets r (place r)) -> near r <= far (explored r) (place r) c.
    Proof.
      intros r c I; unfold near; destruct (nearest r) as [|d l] eqn:E; [lia|].
      assert (In d (nearest r)) as J by (rewrite E; cbn; auto). apply nearest_iff in J; now apply J.
    Qed.
    Lemma targets_iff : forall r u c, In c (targets r u) <->
      In c cells /\ ~ In c (explored r) /\ ~ In c (blocked r) /\ u <> c /\ far (explored r) u c <= length cells.
    Proof. apply targets_spec; assumption. Qed.
    Lemma firsts_iff : forall r c v, In v (firsts r c) <-> In v (beside (place r)) /\ (v = c \/ In v (explored r))
      /\ S (far (explored r) v c) = far (explored r) (place r) c.
    Proof. apply firsts_spec; assumption. Qed.
    Lemma is_placed : forall n i, i < N -> placed V cells beside (at_ n i).
    Proof.
      intros n i I; apply (placed_always V same cells beside obstacle N same_spec beside_cells rl (s n)); auto.
      - apply rl_lasting.
      - apply runs.
    Qed.

    Lemma arrival_nearer : forall t n i, known t -> t <= n -> i < N -> aligned n i -> (exists ms, e n = Arrives i ms) ->
      near (at_ (S n) i) < near (at_ n i).
    Proof.
      intros t n i K L I A [ms E]; destruct (K n i L I) as [K1 K2], (K (S n) i ltac:(lia) I) as [K3 K4].
      destruct (self_step n i I) as [[X _]|[_ O]]; rewrite E in *; [cbn in X; now rewrite Nat.eqb_refl in X|].
      destruct O as [_ [v [D O]]]; unfold self in O; injection O as P _ _; unfold aligned in A; unfold at_ in A at 1; rewrite D in A.
      destruct A as [c [C1 C2]]; rewrite (near_spec _ _ C1). apply nearest_iff in C1; destruct C1 as [C1 _].
      apply targets_iff in C1; apply firsts_iff in C2; destruct C1 as [B1 [B2 [B3 [B4 B5]]]], C2 as [_ [_ F]].
      destruct (is_placed (S n) i I) as [_ [Pl _]]; rewrite P, K3, <- K1 in Pl.
      assert (In c (targets (at_ (S n) i) (place (at_ (S n) i)))) as T.
      { rewrite P; apply targets_iff; rewrite K3, K4, <- K1, <- K2; repeat split; auto; [congruence | lia]. }
      apply near_most in T; rewrite P, K3, <- K1 in T; lia.
    Qed.

    Definition left_ (t k : nat) : nat := total N (fun i => near (at_ (t + k) i)).
    Lemma near_step : forall t n i, known t -> t <= n -> i < N -> aligned n i ->
      near (at_ (S n) i) <= near (at_ n i) /\ (near (at_ (S n) i) = near (at_ n i) -> forall ms, e n <> Arrives i ms).
    Proof.
      intros t n i K L I A; destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:E;
        [| |destruct (Nat.eq_dec j i) as [->|D]; [pose proof (arrival_nearer t n i K L I A (ex_intro _ ms E)); split; [lia|]; lia|]|];
        (split; [|congruence]); apply Nat.eq_le_incl; unfold near; destruct (K n i L I), (K (S n) i ltac:(lia) I);
        (assert (place (at_ (S n) i) = place (at_ n i)) as P;
         [destruct (self_step n i I) as [[_ S]|[X O]]; [now apply self_eq in S|]; rewrite E in *; cbn in O, X |
          destruct (nearest_alike (at_ (S n) i) (at_ n i)) as [-> _]; [repeat split; congruence|];
          destruct (nearest _); [reflexivity | rewrite P; congruence]]).
      - destruct O as [_ [_ [_ O]]]; unfold self in O; now injection O.
      - destruct O as [_ [u [_ [[_ O]|[_ O]]]]]; unfold self in O; [destruct (_ || _)|]; now injection O.
      - apply Nat.eqb_eq in X; congruence.
      - destruct O.
    Qed.

    (** *** Late: nobody learns, arrives or begins to wait any more, no message is missed, and who is under way has decided
        in its own slot. *)
    Section Late.
      Variable t : nat.
      Hypothesis all_known : known t.
      Hypothesis all_heard : forall n, t <= n -> missed (e n) = false.
      Hypothesis all_aligned : forall n i, t <= n -> i < N -> aligned n i.
      Hypothesis all_fresh : forall n i, t <= n -> i < N -> fresh n i.
      Hypothesis no_arrival : forall n i ms, t <= n -> i < N -> e n <> Arrives i ms.

      Lemma no_entry : forall n i v, t <= n -> i < N -> doing (at_ n i) <> Enters v.
      Proof.
        intros n i v L I D; destruct (flier_acts i n I) as [m [Lm [A S]]];
          [apply flying_moves; unfold flying; rewrite D; discriminate|].
        apply self_eq in S; destruct S as [_ [S _]]; rewrite D in S; unfold at_ in S.
        destruct (self_step m i I) as [[X _]|[_ O]]; [congruence|].
        destruct (e m) as [j u c ms|j ms un sl|j ms|] eqn:E; cbn in O; [| | |destruct O].
        - destruct O as [_ [O _]]; unfold Explorers.may_decide, Explorers.moves in O; now rewrite S in O.
        - destruct O as [_ [u [O _]]]; congruence.
        - destruct O as [-> _]; exact (no_arrival m i ms ltac:(lia) I E).
      Qed.

      (** Who acts decides, or meets a robot and waits. *)
      Lemma late_act : forall n i, t <= n -> i < N -> acts i (e n) = true ->
        (exists v c ms, e n = Decides i v c ms /\ may_decide (s n) i = true /\ flying (S n) i /\ waits (at_ (S n) i) = waits (at_ n i))
        \/ (exists v sl, e n = Looks i [] [] sl /\ doing (at_ n i) = Tries v /\ meets V same N (s n) i v <> []
            /\ doing (at_ (S n) i) = Stands /\ waits (at_ (S n) i) = true).
      Proof.
        intros n i L I A; destruct (self_step n i I) as [[X _]|[_ O]]; [congruence|].
        remember (self (at_ (S n) i)) as x eqn:X; unfold self in X; pose proof (all_heard n L) as H.
        destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:E; cbn in O; [| | |destruct O].
        - destruct O as [-> [M [_ O]]]; rewrite O in X; injection X as _ D W; left; exists v, c, ms; unfold flying.
          rewrite <- D, <- W; repeat split; auto; discriminate.
        - destruct O as [-> [v [D O]]]; cbn in H; destruct ms; [|discriminate]; destruct un; [|discriminate].
          destruct O as [[Me O]|[Me O]]; rewrite O in X.
          + exfalso; destruct (obstacle v) eqn:Ob; [clear X|destruct (late (at_ n i) v) eqn:La;
              [|unfold at_ in La; rewrite La in X; injection X as _ D' _; exact (no_entry (S n) i v ltac:(lia) I (eq_sym D'))]].
            2: { unfold Explorers.late in La; destruct (aim (at_ n i)) as [a|] eqn:Ai; [|now rewrite andb_false_r in La].
              rewrite !andb_true_iff in La; destruct La as [[_ Ex] Sa]; apply same_spec in Sa; subst a.
              apply (has_in V same cells beside same_spec beside_cells) in Ex.
              apply (all_fresh n i L I) with (a := v); auto; unfold at_; congruence. }
            assert (In v (blocked (at_ (S n) i))) as B.
            { destruct (proj2 goes_on n) as [y [N' [Y _]]]; rewrite E in N'; cbn [next] in N'; rewrite D in N'.
              destruct (negb _); [discriminate|]; rewrite Me, Ob in N'; injection N' as N'.
              unfold at_; rewrite <- Y by exact I; rewrite <- N', (proj1 (settle_robots _ _ _ _)); cbn.
              unfold tells, put; rewrite Nat.eqb_refl; cbn. apply (in_join V same cells beside same_spec beside_cells); cbn; auto. }
            destruct (all_known (S n) i ltac:(lia) I) as [_ K1], (all_known n i L I) as [_ K2]; rewrite K1, <- K2 in B.
            pose proof (all_aligned n i L I) as Al; unfold aligned in Al; unfold at_ in Al at 1; rewrite D in Al.
            destruct Al as [c [C1 C2]]; apply nearest_iff in C1; destruct C1 as [C1 _]; apply targets_iff in C1.
            apply firsts_iff in C2; destruct C2 as [_ [[->|C2] _]]; [tauto|].
            destruct (FRONTIER_5 V same cells beside obstacle N same_spec beside_cells _ _ (runs n) i I) as [F _].
            apply F in C2; apply (free_always (s n) (runs n)) in C2; congruence.
          + injection X as _ D' W; right; exists v, sl; rewrite <- D', <- W; auto.
        - destruct O as [-> _]; exfalso; exact (no_arrival n i ms L I E).
      Qed.

      Definition lazy (k : nat) : nat := total N (fun i => if waits (at_ (t + k) i) then 0 else 1).
      Lemma waits_stay : forall n i, t <= n -> i < N -> waits (at_ n i) = true -> waits (at_ (S n) i) = true.
      Proof.
        intros n i L I W; destruct (self_step n i I) as [[_ S]|[A _]]; [apply self_eq in S; destruct S as [_ [_ S]]; congruence|].
        destruct (late_act n i L I A) as [[_ [_ [_ [_ [_ [_ H]]]]]]|[_ [_ [_ [_ [_ [_ H]]]]]]]; congruence.
      Qed.
      Lemma lazy_falls : forall k, lazy (S k) <= lazy k.
      Proof.
        intros k; apply total_le; intros i I; cbn beta; destruct (waits (at_ (t + k) i)) eqn:W; [|match goal with |- (if ?b then _ else _) <= _ => destruct b end; lia].
        rewrite Nat.add_succ_r, waits_stay; auto; lia.
      Qed.
      Lemma places_stay : forall n i, t <= n -> i < N -> place (at_ n i) = place (at_ t i).
      Proof.
        intros n i L I; induction L as [|n L IH]; [reflexivity|]; rewrite <- IH.
        destruct (self_step n i I) as [[_ S]|[A O]]; [now apply self_eq in S|].
        unfold self in O; destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:E; cbn in O; [| | |destruct O].
        - destruct O as [_ [_ [_ O]]]; now injection O.
        - destruct O as [_ [v [_ [[_ O]|[_ O]]]]]; [destruct (_ || _)|]; now injection O.
        - destruct O as [-> _]; exfalso; exact (no_arrival n i ms L I E).
      Qed.
      Lemma stays : forall n i, t <= n -> i < N -> alike_maps (at_ n i) (at_ t i).
      Proof. intros n i L I; destruct (all_known n i L I); repeat split; auto; now apply places_stay. Qed.
      Lemma would_stay : forall n i, t <= n -> i < N -> would V rl (s n) i = would V rl (s t) i.
      Proof. intros; apply would_alike, stays; auto. Qed.
      Lemma flier_would : forall n i, t <= n -> i < N -> flying n i -> would V rl (s t) i = true.
      Proof.
        intros n i L I F; rewrite <- (would_stay n i L I); pose proof (all_aligned n i L I) as A; unfold aligned, flying in *.
        assert (exists c v, In c (nearest (at_ n i)) /\ In v (firsts (at_ n i) c)) as [c [v C]]
          by (destruct (doing (at_ n i)); [congruence | |]; destruct A as [c C]; eauto).
        destruct C as [C _]; apply nearest_iff in C; destruct C as [C _]; apply would_iff; intros E; now rewrite E in C.
      Qed.

      Hypothesis all_wait : forall n, t <= n -> lazy (n - t) = lazy 0.
      Lemma waits_same : forall n i, t <= n -> i < N -> waits (at_ n i) = waits (at_ t i).
      Proof.
        intros n i L I; destruct (waits (at_ t i)) eqn:W.
        - induction L as [|n L IH]; [exact W|]. now apply waits_stay.
        - pose proof (all_wait n L) as E; unfold lazy in E; replace (t + (n - t)) with n in E by lia; rewrite Nat.add_0_r in E.
          apply (total_same N (fun i => if waits (at_ t i) then 0 else 1) (fun i => if waits (at_ n i) then 0 else 1)) with (i := i) in E;
            [cbn in E; rewrite W in E; destruct (waits (at_ n i)); congruence | | exact I].
          intros j J; cbn beta; destruct (waits (at_ t j)) eqn:Wj; [|match goal with |- (if ?b then _ else _) <= _ => destruct b end; lia].
          assert (waits (at_ n j) = true) as ->; [|lia]. clear - L J Wj all_known all_heard all_aligned all_fresh no_arrival same_spec beside_cells is_fair goes_on.
          induction L as [|n L IH]; [exact Wj | now apply waits_stay].
      Qed.
      Lemma flier_waits : forall n i, t <= n -> i < N -> flying n i -> waits (at_ t i) = true.
      Proof.
        intros n i L I F; apply flying_moves in F; destruct (flier_acts i n I F) as [m [Lm [A S]]].
        apply flying_moves in F; apply self_eq in S; destruct S as [_ [Sd _]].
        destruct (late_act m i ltac:(lia) I A) as [[v [c [ms [_ [M _]]]]]|[v [sl [_ [_ [_ [_ W]]]]]]].
        - unfold Explorers.may_decide, Explorers.moves in M; unfold flying, at_ in *; rewrite Sd in M.
          destruct (doing (robots (s n) i)); [congruence | discriminate | discriminate].
        - rewrite <- (waits_same (S m) i); auto; lia.
      Qed.
      Lemma actor_waits : forall n i, t <= n -> i < N -> acts i (e n) = true -> waits (at_ t i) = true.
      Proof.
        intros n i L I A; destruct (late_act n i L I A) as [[v [c [ms [_ [_ [F _]]]]]]|[v [sl [_ [D _]]]]].
        - apply (flier_waits (S n) i); auto; lia.
        - apply (flier_waits n i); auto; unfold flying; rewrite D; discriminate.
      Qed.
      Lemma flier_waiting : forall n m i, t <= n -> t <= m -> i < N -> flying n i -> some N (waiting V rl (s m)) = true.
      Proof.
        intros n m i L Lm I F; apply some_spec; exists i; split; [exact I|]; unfold waiting.
        rewrite (would_stay m i Lm I), (flier_would n i L I F); fold (at_ m i); rewrite (waits_same m i Lm I), (flier_waits n i L I F); reflexivity.
      Qed.

      (** One's own slot. *)
      Lemma own_slot : forall i, i < N -> exists u, t <= u /\ forall n, u <= n -> flying n i -> slot (s n) = i.
      Proof.
        intros i I; destruct (lands_or_stays i t I) as [u [L D]]; exists u; split; [exact L|]; intros n Ln.
        induction Ln as [|n Ln IH]; intros F; [unfold flying in F; congruence|].
        assert (t <= n) as Lt by lia. pose proof (flier_waiting (S n) n i ltac:(lia) Lt I F) as W.
        pose proof (flier_waiting (S n) (S n) i ltac:(lia) ltac:(lia) I F) as W'.
        pose proof (step_slot _ _ _ (proj2 goes_on n) W W') as S.
        destruct (self_step n i I) as [[A E]|[A _]].
        - assert (flying n i) as Fn by (apply self_eq in E; destruct E as [_ [E _]]; unfold flying in *; congruence).
          specialize (IH Fn); destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:Ev.
          + destruct S as [_ [_ [-> _]]]; exact IH.
          + destruct S as [_ [_ [-> _]]]; exact IH.
          + exfalso. destruct (step_self _ _ _ (proj2 goes_on n) i I) as [_|_]; destruct (proj2 goes_on n) as [x [X _]]; rewrite Ev in X;
              cbn [next] in X; destruct (doing (robots (s n) j)); try discriminate; destruct (j <? N) eqn:J; try discriminate;
              apply Nat.ltb_lt in J; exact (no_arrival n j ms Lt J Ev).
          + exfalso; destruct S as [M _]; unfold Explorers.may_tick in M; rewrite !andb_true_iff, !negb_true_iff in M; destruct M as [_ M].
            apply not_true_iff_false in M; apply M, some_spec; exists i; split; [exact I|].
            apply flying_moves in Fn; rewrite Fn, IH, Nat.eqb_refl; now rewrite orb_true_r.
        - destruct (late_act n i Lt I A) as [[v [c [ms [Ev [M _]]]]]|[v [sl [_ [_ [_ [D' _]]]]]]]; [|unfold flying in F; congruence].
          rewrite Ev in S; destruct S as [_ [_ [-> _]]]; unfold Explorers.may_decide in M; rewrite !andb_true_iff in M.
          destruct M as [_ M]; fold (at_ n i) in M; rewrite (waits_same n i Lt I), (actor_waits n i Lt I A) in M.
          cbn in M; apply andb_true_iff in M; destruct M as [M _]; now apply Nat.eqb_eq in M.
      Qed.

      Variable u : nat.
      Hypothesis later : t <= u.
      Hypothesis own : forall n i, u <= n -> i < N -> flying n i -> slot (s n) = i.

      Lemma no_arrive : forall n i ms, t <= n -> e n <> Arrives i ms.
      Proof.
        intros n i ms L E; destruct (proj2 goes_on n) as [x [X _]]; rewrite E in X; cbn [next] in X.
        destruct (doing (robots (s n) i)); try discriminate. destruct (i <? N) eqn:I; [|discriminate].
        apply Nat.ltb_lt in I; exact (no_arrival n i ms L I E).
      Qed.
      Lemma waiting_stay : forall n i, t <= n -> i < N -> waiting V rl (s n) i = waiting V rl (s t) i.
      Proof.
        intros n i L I; unfold waiting; rewrite (would_stay n i L I); f_equal; exact (waits_same n i L I).
      Qed.
      Definition quiet (n : nat) : Prop := forall k, k < N -> ~ flying n k.

      Lemma slot_robot : forall n, 0 < N -> slot (s n) < N.
      Proof. intros n; eapply slot_always; [exact same_spec | exact beside_cells | apply runs]. Qed.

      Section Busy.
        Variable w : nat.
        Hypothesis w_robot : w < N.
        Hypothesis w_waits : waiting V rl (s t) w = true.
        Lemma busy : forall n, t <= n -> some N (waiting V rl (s n)) = true.
        Proof. intros n L; apply some_spec; exists w; split; [exact w_robot|]. now rewrite waiting_stay. Qed.

        (** What may happen: the robot whose slot it is goes to the rim, or looks; or the slot is over. *)
        Lemma happens : forall n, u <= n ->
          (exists j, j < N /\ acts j (e n) = true /\ slot (s n) = j /\ tried (s n) = false /\ ~ flying n j /\ flying (S n) j /\ slot (s (S n)) = j)
          \/ (exists j, j < N /\ flying n j /\ slot (s (S n)) = slot (s n) /\ tried (s (S n)) = true /\ quiet (S n))
          \/ (e n = Ticks /\ may_tick (s n) = true /\ slot (s (S n)) = (slot (s n) + 1) mod N /\ tried (s (S n)) = false
              /\ quiet n /\ quiet (S n)).
        Proof.
          intros n L; assert (t <= n) as Lt by lia.
          pose proof (step_slot _ _ _ (proj2 goes_on n) (busy n Lt) (busy (S n) ltac:(lia))) as S.
          destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:E.
          - destruct S as [J [M [S1 S2]]]; left; exists j; cbn [acts]; rewrite Nat.eqb_refl.
            assert (acts j (e n) = true) as A by (rewrite E; cbn; apply Nat.eqb_refl).
            destruct (late_act n j Lt J A) as [[v' [c' [ms' [_ [_ [F _]]]]]]|[v' [sl' [X _]]]]; [|congruence].
            pose proof (actor_waits n j Lt J A) as W; rewrite <- (waits_same n j Lt J) in W; unfold at_ in W.
            unfold Explorers.may_decide in M; rewrite W in M; rewrite !andb_true_iff in M; destruct M as [[M1 _] M2].
            cbn in M2; apply andb_true_iff in M2; destruct M2 as [M2 M3]; apply Nat.eqb_eq in M2; apply negb_true_iff in M3, M1.
            assert (~ flying n j) as Fn by (rewrite flying_moves; congruence). rewrite S1, M2; auto 9.
          - destruct S as [J [M [S1 S2]]]; right; left; exists j; apply flying_moves in M.
            assert (acts j (e n) = true) as A by (rewrite E; cbn; apply Nat.eqb_refl).
            destruct (late_act n j Lt J A) as [[v' [c' [ms' [X _]]]]|[v' [sl' [_ [D [Me [St _]]]]]]]; [congruence|].
            unfold at_ in D; rewrite D in S2; repeat split; auto.
            + rewrite (S2 Me), (own n j L J M), Nat.eqb_refl; apply orb_true_r.
            + intros k K F; destruct (Nat.eq_dec k j) as [->|Ne]; [unfold flying in F; congruence|].
              destruct (self_step n k K) as [[_ Sk]|[X _]]; [|rewrite E in X; cbn in X; apply Nat.eqb_eq in X; congruence].
              apply self_eq in Sk; destruct Sk as [_ [Sk _]]. assert (flying n k) as Fk by (unfold flying in *; congruence).
              apply Ne; rewrite <- (own n k L K Fk); now rewrite <- (own n j L J M).
          - exfalso; exact (no_arrive n j ms Lt E).
          - destruct S as [M [S1 S2]]; right; right.
            assert (quiet n) as Q.
            { intros k K F; pose proof M as M'; unfold Explorers.may_tick in M'; rewrite !andb_true_iff, !negb_true_iff in M'.
              destruct M' as [_ M']; apply not_true_iff_false in M'; apply M', some_spec; exists k; split; [exact K|].
              pose proof (own n k L K F) as O; apply flying_moves in F; rewrite F, O, Nat.eqb_refl; now rewrite orb_true_r. }
            repeat split; auto. intros k K F; apply (Q k K).
            destruct (self_step n k K) as [[_ Sk]|[X _]]; [|rewrite E in X; discriminate].
            apply self_eq in Sk; destruct Sk as [_ [Sk _]]; unfold flying in *; congruence.
        Qed.
        Lemma tick_comes : forall n, u <= n -> exists m, n <= m /\ e m = Ticks /\ slot (s m) = slot (s n).
        Proof.
          assert (forall n, u <= n -> (exists j, j < N /\ flying n j) -> forall j, j < N -> flying n j ->
            slot (s (S n)) = slot (s n) /\ quiet (S n) /\ tried (s (S n)) = true) as Look.
          { intros n L _ j J F; destruct (happens n L) as [[k [K [_ [Sk [_ [Fk _]]]]]]|[[k [K [Fk [S1 [S2 Q]]]]]|[_ [_ [_ [_ [Q _]]]]]]].
            - exfalso; rewrite (own n j L J F) in Sk; now subst.
            - auto.
            - exfalso; exact (Q j J F). }
          assert (forall n, u <= n -> quiet n -> tried (s n) = true -> e n = Ticks) as Tick.
          { intros n L Q T; destruct (happens n L) as [[k [K [_ [_ [X _]]]]]|[[k [K [Fk _]]]|[X _]]]; [congruence | exfalso; exact (Q k K Fk) | exact X]. }
          intros n L; destruct (happens n L) as [[k [K [_ [Sk [_ [_ [Fk S1]]]]]]]|[[k [K [Fk [S1 [S2 Q]]]]]|[X _]]].
          - destruct (Look (S n) ltac:(lia) (ex_intro _ k (conj K Fk)) k K Fk) as [A [B C]].
            exists (S (S n)); repeat split; [lia | apply Tick; auto; lia | congruence].
          - exists (S n); repeat split; [lia | apply Tick; auto; lia | congruence].
          - exists n; auto.
        Qed.
        Lemma slot_comes : forall k n, u <= n -> exists m, n <= m /\ slot (s m) = (slot (s n) + k) mod N
          /\ (0 < k -> tried (s m) = false /\ quiet m).
        Proof.
          induction k as [|k IH]; intros n L.
          - exists n; split; [lia|]; split; [|lia]. rewrite Nat.add_0_r, Nat.mod_small; [reflexivity | apply slot_robot; lia].
          - destruct (IH n L) as [m [Lm [Sm _]]]; destruct (tick_comes m ltac:(lia)) as [m' [L' [E S']]].
            destruct (happens m' ltac:(lia)) as [[j [J [A _]]]|[[j [J [Fj [_ [T _]]]]]|[_ [_ [X [T [_ Q]]]]]]];
              [rewrite E in A; discriminate | |].
            + exfalso; destruct (self_step m' j J) as [[_ Sk]|[X _]]; [|rewrite E in X; discriminate].
              pose proof (step_slot _ _ _ (proj2 goes_on m') (busy m' ltac:(lia)) (busy (S m') ltac:(lia))) as S; rewrite E in S.
              destruct S as [_ [_ S]]; congruence.
            + exists (S m'); split; [lia|]; split; [|auto]. rewrite X, S', Sm, Nat.add_mod_idemp_l by lia; f_equal; lia.
        Qed.
        Lemma looks_comes : exists m v sl, u <= m /\ e m = Looks w [] [] sl /\ doing (at_ m w) = Tries v
          /\ meets V same N (s m) w v <> [].
        Proof.
          assert (slot (s u) < N) as Su by (apply slot_robot; lia).
          destruct (slot_comes (N + w - slot (s u)) u (le_n u)) as [m [L [Sl Q]]]; destruct Q as [T Q]; [lia|].
          replace (slot (s u) + (N + w - slot (s u))) with (w + 1 * N) in Sl by lia.
          rewrite Nat.mod_add, Nat.mod_small in Sl by lia.
          destruct (happens m L) as [[j [J [_ [Sj [_ [_ [F _]]]]]]]|[[j [J [F _]]]|[_ [M _]]]].
          - assert (j = w) as -> by congruence. apply flying_moves in F; destruct (flier_acts w (S m) J F) as [k [Lk [A Sk]]].
            destruct (late_act k w ltac:(lia) J A) as [[v [c [ms [_ [M _]]]]]|[v [sl [E [D [Me _]]]]]].
            + exfalso; apply self_eq in Sk; destruct Sk as [_ [Sk _]]; unfold Explorers.may_decide, Explorers.moves, at_ in *.
              rewrite Sk in M; destruct (doing (robots (s (S m)) w)); discriminate.
            + exists k, v, sl; repeat split; auto; lia.
          - exfalso; exact (Q j J F).
          - exfalso; unfold Explorers.may_tick in M; rewrite Sl, T, waiting_stay, w_waits in M by (auto; lia).
            rewrite andb_false_r in M; discriminate.
        Qed.
      End Busy.

      Lemma would_waits : forall i, i < N -> would V rl (s t) i = true -> waiting V rl (s t) i = true.
      Proof.
        intros i I W; unfold waiting; rewrite W, andb_true_r; destruct (proj1 is_fair i t I) as [m [L [A|A]]].
        - exact (actor_waits m i L I A).
        - unfold able in A; apply orb_false_iff in A; destruct A as [A B]; unfold Explorers.may_decide in B.
          rewrite A, (would_stay m i L I), W in B; cbn in B; apply orb_false_iff in B; destruct B as [B _].
          apply negb_false_iff in B; pose proof (waits_same m i L I) as E; unfold at_ in E; congruence.
      Qed.

      Lemma far_same : forall e1 e2, (forall v, In v e1 <-> In v e2) -> forall v c, far e1 v c = far e2 v c.
      Proof.
        intros e1 e2 H v c; unfold Explorers.far. assert (forall B, grows V same cells beside e1 c B = grows V same cells beside e2 c B) as G.
        { intros B; unfold grows; apply filter_ext; intros x; rewrite !lazy_or; f_equal.
          induction (beside x) as [|y l IH]; cbn; [reflexivity|]. rewrite IH, !lazy_and; f_equal; f_equal; f_equal. apply eq_true_iff_eq; rewrite !(has_in V same cells beside same_spec beside_cells); apply H. }
        generalize [c]; generalize (S (length cells)); induction n as [|n IH]; intros B; cbn; [reflexivity|].
        now rewrite G, IH.
      Qed.

      (** A robot with a way meets one that is nearer. *)
      Lemma nobody_would : forall d i, i < N -> would V rl (s t) i = true -> near (at_ t i) = d -> False.
      Proof.
        induction d as [d IH] using lt_wf_ind; intros i I W D.
        destruct (looks_comes i I (would_waits i I W)) as [m [v [sl [L [E [Do Me]]]]]]. assert (t <= m) as Lt by lia.
        destruct (meets V same N (s m) i v) as [|r met] eqn:M; [congruence|].
        assert (In r (meets V same N (s m) i v)) as R by (rewrite M; cbn; auto).
        assert (r < N) as Rn by (eapply meets_robots; eauto). pose proof R as R'; apply filter_In in R'; destruct R' as [_ R'].
        apply andb_true_iff in R'; destruct R' as [Ne R']; apply negb_true_iff, Nat.eqb_neq in Ne.
        assert (flying m i) as Fi by (unfold flying; rewrite Do; discriminate).
        assert (place (at_ m r) = v) as P.
        { unfold at_; destruct (doing (robots (s m) r)) eqn:Dr; [rewrite orb_false_r in R'; now apply same_spec in R'| |];
            exfalso; apply Ne; rewrite <- (own m r ltac:(lia) Rn) by (unfold flying, at_; rewrite Dr; discriminate);
            exact (own m i ltac:(lia) I Fi). }
        pose proof (proj2 goes_on m) as St; rewrite E in St.
        destruct (all_known m i Lt I) as [Ai Bi], (all_known m r Lt Rn) as [Ar Br], (all_known (S m) i ltac:(lia) I) as [Ai' Bi'],
          (all_known (S m) r ltac:(lia) Rn) as [Ar' Br']. unfold at_ in *.
        assert (forall c, (In c (explored (robots (s t) i)) <-> In c (explored (robots (s t) r)))
          /\ (In c (blocked (robots (s t) i)) <-> In c (blocked (robots (s t) r)))) as Same.
        { intros c; destruct (step_meets _ _ _ _ _ _ St I Do R c) as [X Y]; rewrite Ai, Ar, Ai', Ar' in X; rewrite Bi, Br, Bi', Br' in Y; tauto. }
        pose proof (all_aligned m i Lt I) as Al; unfold aligned, at_ in Al; rewrite Do in Al.
        destruct (nearest_alike _ _ (stays m i Lt I)) as [Ne1 Fi1]; unfold at_ in Ne1, Fi1; rewrite Ne1 in Al.
        destruct Al as [c [C1 C2]]; rewrite Fi1 in C2; rewrite (near_spec _ _ C1) in D.
        apply nearest_iff in C1; destruct C1 as [C1 _]; apply targets_iff in C1; apply firsts_iff in C2.
        destruct C1 as [T1 [T2 [T3 [T4 T5]]]], C2 as [_ [V1 F1]].
        pose proof (places_stay m r Lt Rn) as Pr; unfold at_ in Pr; rewrite P in Pr.
        destruct (is_placed t r Rn) as [_ [Pe _]]; unfold at_ in Pe; rewrite <- Pr in Pe; apply Same in Pe.
        assert (v <> c) as Vc by (intros <-; tauto).
        assert (In c (targets (robots (s t) r) (place (robots (s t) r)))) as T.
        { rewrite <- Pr; apply targets_iff. rewrite <- (far_same _ _ (fun v => proj1 (Same v))).
          repeat split; auto; [rewrite <- (proj1 (Same c)) | rewrite <- (proj2 (Same c)) | lia]; assumption. }
        pose proof (near_most _ _ T) as Nm; rewrite <- Pr, <- (far_same _ _ (fun v => proj1 (Same v))) in Nm.
        apply (IH (near (robots (s t) r)) ltac:(lia) r Rn); [|reflexivity].
        apply would_iff; intros C; unfold at_ in C; now rewrite C in T.
      Qed.
      Lemma late_run_ends : False.
      Proof.
        destruct (proj2 goes_on u) as [x [X _]]; destruct (e u) as [j v c ms|j ms un sl|j ms|] eqn:E; cbn [next] in X.
        - destruct (_ && _) eqn:G; [|discriminate]; rewrite !andb_true_iff, Nat.ltb_lt in G; destruct G as [[J M] _].
          unfold Explorers.may_decide in M; rewrite !andb_true_iff in M; destruct M as [[_ M] _].
          rewrite (would_stay u j later J) in M; exact (nobody_would _ j J M eq_refl).
        - destruct (doing (robots (s u) j)) as [|v|v] eqn:D; try discriminate. destruct (j <? N) eqn:J; [|discriminate].
          apply Nat.ltb_lt in J; apply (nobody_would _ j J (flier_would u j later J ltac:(unfold flying, at_; rewrite D; discriminate)) eq_refl).
        - exact (no_arrive u j ms later E).
        - destruct (may_tick (s u)) eqn:M; [|discriminate]; unfold Explorers.may_tick in M; rewrite !andb_true_iff in M.
          destruct M as [[M _] _]; apply some_spec in M; destruct M as [j [J M]]; rewrite (waiting_stay u j later J) in M.
          unfold waiting in M; apply andb_true_iff in M; destruct M as [_ M]; exact (nobody_would _ j J M eq_refl).
      Qed.
    End Late.
  End Endless.

  (** There is no such run. *)
  Theorem plain_in_the_end_ends : forall s e, endless s e -> fair s e -> plain_in_the_end s e ->
    (exists t, forall n, t <= n -> missed (e n) = false) -> False.
  Proof.
    intros s e G F [tp Pl] [t0 H]; apply (constant (fun n => learnt s n)); [apply (learnt_falls s e G)|]; intros t1' K'.
    apply (learnt_same s e G) in K'; remember (t1' + tp) as t1 eqn:T1.
    assert (known s t1) as K.
    { intros n i L I; destruct (K' n i ltac:(lia) I) as [-> ->], (K' t1 i ltac:(lia) I) as [-> ->]; auto. }
    destruct (under_way_in_the_end s e G F tp Pl t1 K ltac:(lia)) as [t2 [L2 A]].
    assert (forall t, t1 <= t -> known s t) as Kn.
    { intros t L n i Ln I; destruct (K n i ltac:(lia) I) as [-> ->], (K t i L I) as [-> ->]; auto. }
    apply (constant (left_ s (t0 + t2))).
    { intros k; apply total_le; intros i I; rewrite Nat.add_succ_r.
      apply (near_step s e G t2 (t0 + t2 + k) i (Kn t2 L2) ltac:(lia) I (proj1 (A (t0 + t2 + k) i ltac:(lia) I))). }
    intros k C; assert (exists t, t = t0 + t2 + k) as [t Et] by eauto.
    assert (forall n i ms, t <= n -> i < N -> e n <> Arrives i ms) as NoA.
    { intros n i ms L I. assert (left_ s (t0 + t2) (S (n - (t0 + t2))) = left_ s (t0 + t2) (n - (t0 + t2))) as E
        by (rewrite (C (S (n - (t0 + t2)))), (C (n - (t0 + t2))) by lia; reflexivity).
      unfold left_ in E; rewrite Nat.add_succ_r in E; replace (t0 + t2 + (n - (t0 + t2))) with n in E by lia.
      assert (forall i, i < N -> near (at_ s (S n) i) <= near (at_ s n i) /\ (near (at_ s (S n) i) = near (at_ s n i) ->
        forall ms, e n <> Arrives i ms)) as St
        by (intros j J; exact (near_step s e G t2 n j (Kn t2 L2) ltac:(lia) J (proj1 (A n j ltac:(lia) J)))).
      apply (St i I). exact (total_same N (fun i => near (at_ s n i)) (fun i => near (at_ s (S n) i)) (fun i I => proj1 (St i I)) E i I). }
    assert (forall n, t <= n -> missed (e n) = false) as Hd by (intros; apply H; lia).
    assert (forall n i, t <= n -> i < N -> aligned s n i) as Al by (intros; apply A; auto; lia).
    assert (forall n i, t <= n -> i < N -> fresh s n i) as Fr by (intros n i L I; apply A; auto; lia).
    apply (constant (lazy s t)).
    { apply (lazy_falls s e G F t (Kn t ltac:(lia)) Hd Al Fr NoA). }
    intros k' W; assert (exists t', t' = t + k') as [t' Et'] by eauto.
    assert (forall n, t' <= n -> lazy s t' (n - t') = lazy s t' 0) as W'.
    { intros n L; unfold lazy in *; pose proof (W (n - t) ltac:(lia)) as E; rewrite Et'.
      replace (t + k' + (n - (t + k'))) with (t + (n - t)) by lia; rewrite Nat.add_0_r; exact E. }
    assert (forall n, t' <= n -> missed (e n) = false) as Hd' by (intros; apply H; lia).
    assert (forall n i, t' <= n -> i < N -> aligned s n i) as Al' by (intros; apply A; auto; lia).
    assert (forall n i, t' <= n -> i < N -> fresh s n i) as Fr' by (intros n i L I; apply A; auto; lia).
    assert (forall n i ms, t' <= n -> i < N -> e n <> Arrives i ms) as NoA' by (intros; apply NoA; auto; lia).
    destruct (all_in_the_end (fun i u => t' <= u /\ forall n, u <= n -> flying s n i -> slot (s n) = i) N) as [u U].
    - intros i a b L [X Y]; split; [lia | intros; apply Y; auto; lia].
    - intros i I; exact (own_slot s e G F t' (Kn t' ltac:(lia)) Hd' Al' Fr' NoA' W' i I).
    - apply (late_run_ends s e G F t' (Kn t' ltac:(lia)) Hd' Al' Fr' NoA' W' (t' + u)); [lia|].
      intros n i L I; apply (proj2 (U i I)); lia.
  Qed.

End Area.

(** FRONTIER-3, plain. *)
Theorem plain_lasting : forall V same cells beside, (forall a b : V, same a b = true <-> a = b) ->
  (forall u v : V, In v (beside u) -> In v cells) -> lasting V same cells beside (PLAIN V same cells beside).
Proof.
  intros V same cells beside S B; split; [now apply plain_sensible|]. intros i r T.
  destruct (chooses _ i r) as [|[v c] l] eqn:C; [reflexivity|]. assert (In (v, c) (chooses (PLAIN V same cells beside) i r)) as I
    by (rewrite C; now left). apply plain_spec in I; auto. destruct I as [I _]; apply nearest_spec in I; auto.
  destruct I as [I _]; now rewrite T in I.
Qed.
Theorem FRONTIER_3 : forall (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool)
  (N : nat), (forall a b : V, same a b = true <-> a = b) -> (forall u v : V, In v (beside u) -> In v cells) ->
  forall s e, endless V same cells obstacle N (PLAIN V same cells beside) s e -> fair V N (PLAIN V same cells beside) s e ->
  (exists t, forall n, t <= n -> missed V (e n) = false) -> False.
Proof.
  intros V same cells beside obstacle N S B s e G F M.
  apply (plain_in_the_end_ends V same cells beside obstacle N S B (PLAIN V same cells beside) (plain_lasting V same cells beside S B) s e G F); [|exact M].
  exists 0; intros n i v c ms _ E. destruct (proj2 G n) as [x [X _]]; rewrite E in X; cbn [next] in X.
  destruct (_ && _) eqn:D; [|discriminate]; rewrite andb_true_iff in D; destruct D as [_ D].
  apply existsb_exists in D; destruct D as [[v' c'] [D Q]]; cbn in Q; apply andb_true_iff in Q; destruct Q as [Q1 Q2].
  apply S in Q1, Q2; subst; now apply plain_spec in D.
Qed.
