(** FRONTIER-3 of robots with preferences: every run ends by any rule by which a robot without news goes to no cell that is
    farther than the one it has claimed, and to a nearest one if it has claimed none. For every number of robots, every
    finite graph of cells, every set of obstacles, and finitely many missed messages.

    When nobody learns anything new any more, the way to what a robot has claimed never grows, and each arrival makes it
    shorter. So nobody arrives in the end; then robots only meet others, and go to nearest cells. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Frontier Explorers ExplorersEnd.
Import ListNotations.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool).
  Variable N : nat.
  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_cells : forall u v, In v (beside u) -> In v cells.
  Notation far := (far V same cells beside).
  Notation nearest := (nearest V same cells beside).
  Notation firsts := (firsts V same cells beside).
  Notation targets := (targets V same cells beside).
  Notation near := (near V same cells beside).

  (** Robots tell what they have claimed, and keep to it without news. *)
  Definition keeping (rl : rule V) : Prop :=
    claims rl = true /\ forall i r v c, In (v, c) (chooses rl i r) ->
      In c (targets r (place r)) /\ In v (firsts r c) /\ (news r = false -> match aim r with
        | Some a => In a (targets r (place r)) -> far (explored r) (place r) c <= far (explored r) (place r) a
        | None => In c (nearest r)
        end).
  Variable rl : rule V.
  Hypothesis rl_lasting : lasting V same cells beside rl.
  Hypothesis rl_keeping : keeping rl.
  Notation leads := (leads V same obstacle N rl).
  Notation step_aim := (step_aim V same cells beside obstacle N same_spec beside_cells rl).

  (** It looks into an explored cell that it has claimed, and turns back. *)
  Definition goes_back (w : world V) (i : nat) : bool :=
    match doing (robots w i) with
    | Tries v => match meets V same N w i v with
        | [] => negb (obstacle v) && late V same rl (robots w i) v | _ :: _ => false end
    | Stands | Enters _ => false
    end.

  (** What a step makes of news, where maps do not grow. *)
  Lemma step_news : forall w e w', leads w e w' -> forall i, i < N -> explored (robots w' i) = explored (robots w i) ->
    blocked (robots w' i) = blocked (robots w i) -> news (robots w' i) = match e with
      | Looks j _ _ _ => if j =? i then goes_back w i else news (robots w i) | _ => news (robots w i) end.
  Proof.
    assert (forall l x : list V, l ++ x = l -> x = []) as Nil.
    { intros l x E; rewrite <- (app_nil_r l) in E at 2; now apply app_inv_head in E. }
    assert (forall l m, join V same l m = l -> grows_by V same l m = false) as G.
    { intros l m E; apply Nil in E; unfold grows_by; apply negb_false_iff, forallb_forall; intros v I.
      destruct (Explorers.has V same l v) eqn:H; [reflexivity|].
      assert (In v (filter (fun v => negb (Explorers.has V same l v)) m)) as F by (apply filter_In; rewrite H; auto).
      now rewrite E in F. }
    assert (forall r j said, explored (hears V same r j said) = explored r -> blocked (hears V same r j said) = blocked r ->
      news (hears V same r j said) = news r) as H by (intros r j said E B; cbn in *; now rewrite (G _ _ E), (G _ _ B), !orb_false_r).
    assert (forall (f : nat -> robot V) l r q, longer V q r -> longer V q (fold_left (fun r j => hears V same r j (f j)) l r)) as Lo
      by (intros f; induction l as [|k l IH]; intros r q L; cbn; [exact L | now apply IH, longer_hears]).
    assert (forall (f : nat -> robot V) l r, let q := fold_left (fun r j => hears V same r j (f j)) l r in
      explored q = explored r -> blocked q = blocked r -> news q = news r) as F.
    { intros f; induction l as [|k l IH]; intros r; cbn zeta; cbn [fold_left]; [reflexivity|]; intros E B.
      destruct (Lo f l (hears V same r k (f k)) _ (longer_self V _)) as [x [y [X Y]]]; rewrite X in E; rewrite Y in B.
      cbn [hears explored blocked] in E, B; unfold join in E, B; rewrite <- app_assoc in E, B.
      apply Nil, app_eq_nil in E; apply Nil, app_eq_nil in B; destruct E as [E1 E2], B as [B1 B2]; subst x y.
      assert (explored (hears V same r k (f k)) = explored r /\ blocked (hears V same r k (f k)) = blocked r) as [Hx Hy]
        by (cbn [hears explored blocked]; unfold join; now rewrite E1, B1, !app_nil_r).
      rewrite <- (H r k (f k) Hx Hy); apply IH; [rewrite X | rewrite Y]; apply app_nil_r. }
    assert (forall (f : nat -> robot V) j ms k, explored (tells V same f j ms k) = explored (f k) ->
      blocked (tells V same f j ms k) = blocked (f k) -> news (tells V same f j ms k) = news (f k)) as T
      by (intros f j ms k; unfold tells; destruct ((k =? j) || is_in k ms); auto).
    intros w e w' [x [E [A _]]] i I; rewrite <- A by exact I; clear A.
    destruct e as [j v c ms | j ms un sl | j ms |]; cbn [next] in E.
    - destruct (_ && _); [|discriminate]; injection E as <-; cbn [robots with_robots]; rewrite (proj1 rl_keeping).
      set (f := put _ _ _); intros X Y.
      assert (explored (f i) = explored (robots w i) /\ blocked (f i) = blocked (robots w i)
        /\ news (f i) = news (robots w i)) as [Fx [Fy Fn]]
        by (unfold f, put; rewrite (Nat.eqb_sym i j); destruct (j =? i) eqn:J; [apply Nat.eqb_eq in J; subst|]; auto).
      rewrite <- Fn; apply T; congruence.
    - destruct (doing (robots w j)) as [|v|v] eqn:D; try discriminate. destruct (negb _); [discriminate|].
      destruct (meets V same N w j v) as [|k met] eqn:M; injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots with_robots];
        assert (goes_back w j = match meets V same N w j v with [] => negb (obstacle v) && late V same rl (robots w j) v
          | _ :: _ => false end) as Gb by (unfold goes_back; now rewrite D); rewrite M in Gb.
      + destruct (obstacle v); cbn [negb andb] in Gb.
        * set (f := put _ _ _); intros X Y.
          assert (longer V (robots w i) (f i)) as [x [y [Fx Fy]]].
          { unfold f, put; destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i|apply longer_self].
            eexists [], _; split; [now rewrite app_nil_r | reflexivity]. }
          assert (longer V (f i) (tells V same f j ms i)) as [x' [y' [Tx Ty]]]
            by (unfold tells; destruct ((i =? j) || is_in i ms); [apply longer_self | apply longer_hears, longer_self]).
          rewrite Tx, Fx, <- app_assoc in X; rewrite Ty, Fy, <- app_assoc in Y; apply Nil, app_eq_nil in X; apply Nil, app_eq_nil in Y.
          destruct X as [-> ->], Y as [-> ->]; rewrite app_nil_r in *; rewrite (T f j ms i Tx Ty).
          revert Fy; unfold f, put; rewrite (Nat.eqb_sym j i); destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i; rewrite Gb|auto]; cbn; intros Fy.
          exact (G _ _ Fy).
        * unfold put; rewrite (Nat.eqb_sym j i); destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i|]; auto.
          rewrite Gb; now destruct (late _ _ _ _ _).
      + set (f := tells V same _ j ms).
        assert (longer V (robots w i) (f i) /\ (explored (f i) = explored (robots w i) -> blocked (f i) = blocked (robots w i) ->
          news (f i) = if j =? i then goes_back w i else news (robots w i))) as [Lf Nf].
        { set (g := put (robots w) j (becomes V (robots w j) Stands None true)) in f.
          assert (explored (g i) = explored (robots w i) /\ blocked (g i) = blocked (robots w i) /\ news (g i) = if j =? i then goes_back w i else news (robots w i)) as [Gx [Gy Gn]]
            by (unfold g, put; rewrite (Nat.eqb_sym j i); destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i; rewrite Gb|]; auto).
          split; [|intros X Y; rewrite <- Gn; apply T; unfold f in *; congruence].
          unfold f, tells; destruct ((i =? j) || is_in i ms); [|apply longer_hears]; apply longer_same; auto. }
        rewrite (Nat.eqb_sym j i) in Nf |- *; unfold is_told, put; destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i | exact Nf].
        match goal with |- context [fold_left _ ?m (f j)] => generalize m end; intros l X Y; destruct (Lo f l (f j) _ (longer_self V _)) as [x [y [Lx Ly]]], Lf as [x' [y' [Fx Fy]]].
        rewrite Lx, Fx, <- app_assoc in X; rewrite Ly, Fy, <- app_assoc in Y; apply Nil, app_eq_nil in X; apply Nil, app_eq_nil in Y.
        destruct X as [-> ->], Y as [-> ->]; rewrite app_nil_r in *; rewrite (F f l (f j) Lx Ly); now apply Nf.
    - destruct (doing (robots w j)) as [|v|v] eqn:D; try discriminate. destruct (j <? N); [|discriminate].
      injection E as <-; rewrite (proj1 (settle_robots _ _ _ _)); cbn [robots]; set (f := put _ _ _); intros X Y.
      assert (longer V (robots w i) (f i)) as [x [y [Fx Fy]]].
      { unfold f, put; destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i|apply longer_self].
        eexists _, []; split; [reflexivity | now rewrite app_nil_r]. }
      assert (longer V (f i) (tells V same f j ms i)) as [x' [y' [Tx Ty]]]
        by (unfold tells; destruct ((i =? j) || is_in i ms); [apply longer_self | apply longer_hears, longer_self]).
      rewrite Tx, Fx, <- app_assoc in X; rewrite Ty, Fy, <- app_assoc in Y; apply Nil, app_eq_nil in X; apply Nil, app_eq_nil in Y.
      destruct X as [-> ->], Y as [-> ->]; rewrite app_nil_r in *; rewrite (T f j ms i Tx Ty).
      revert Fx; unfold f, put; destruct (i =? j) eqn:J; [apply Nat.eqb_eq in J; subst i|auto]; cbn; intros Fx.
      now rewrite (G _ _ Fx), orb_false_r.
    - destruct (may_tick _ _ _ _); [|discriminate]; injection E as <-; auto.
  Qed.

  (** A robot is settled that has no news, and has claimed what is left, or has met another one. *)
  Definition has := has V same.
  Definition settled (r : robot V) : bool :=
    negb (news r) && match aim r with
    | Some a => has (targets r (place r)) a && match doing r with Stands => true | Tries v | Enters v => has (firsts r a) v end
    | None => match doing r with Stands => true | Tries _ | Enters _ => false end
    end.
  Definition aimed (r : robot V) : Prop :=
    match aim r with
    | Some a => In a (targets r (place r)) /\ match doing r with Stands => True | Tries v | Enters v => In v (firsts r a) end
    | None => doing r = Stands
    end.
  Lemma settled_iff : forall r, settled r = true <-> news r = false /\ aimed r.
  Proof.
    intros r; unfold settled, aimed; rewrite andb_true_iff, negb_true_iff. apply and_iff_compat_l; destruct (aim r) as [a|].
    - rewrite andb_true_iff; unfold has; rewrite (has_in V same cells beside same_spec beside_cells).
      destruct (doing r); rewrite ?(has_in V same cells beside same_spec beside_cells); intuition.
    - destruct (doing r); intuition congruence.
  Qed.
  (** How far it may go, and whether that is farther than a nearest cell. *)
  Definition most (r : robot V) : nat := match aim r with Some a => far (explored r) (place r) a | None => near r end.
  Definition weight (r : robot V) : nat :=
    if settled r then 2 * most r + (if most r =? near r then 0 else 1) else 2 * length cells + 2.
  Lemma near_cells : forall r, near r <= length cells.
  Proof.
    intros r; unfold ExplorersEnd.near; destruct (nearest r) as [|c l] eqn:E; [lia|].
    assert (In c (nearest r)) as I by (rewrite E; now left). apply nearest_spec in I; auto; destruct I as [I _].
    apply targets_spec in I; auto; tauto.
  Qed.
  Lemma settled_most : forall r, settled r = true -> near r <= most r <= length cells.
  Proof.
    intros r S; apply settled_iff in S; destruct S as [_ S]; unfold aimed in S; unfold most; destruct (aim r) as [a|]; [|split; [lia | apply near_cells]].
    destruct S as [S _]; split; [now apply (near_most V same cells beside same_spec beside_cells) | apply targets_spec in S; auto; tauto].
  Qed.
  Lemma settled_weight : forall r, settled r = true <-> weight r < 2 * length cells + 2.
  Proof.
    intros r; unfold weight; destruct (settled r) eqn:S; [|split; [discriminate | lia]].
    apply settled_most in S; destruct (_ =? _); split; auto; lia.
  Qed.
  Lemma weight_alike : forall r r', alike_maps V r r' -> self V r = self V r' -> aim r = aim r' -> news r = news r' ->
    weight r = weight r'.
  Proof.
    intros r r' Al S A Nw; destruct (nearest_alike V same cells beside r r' Al) as [Ne Fi]; destruct Al as [E [B P]].
    injection S as _ D W. assert (targets r (place r) = targets r' (place r')) as T by (unfold Explorers.targets; now rewrite E, B, P).
    unfold weight, settled, most, ExplorersEnd.near; rewrite A, D, T, Ne, E, P, Nw.
    destruct (aim r') as [a|]; [|reflexivity]. now rewrite !Fi.
  Qed.

  Section Endless.
    Variables (s : nat -> world V) (e : nat -> event V).
    Hypothesis goes_on : endless V same cells obstacle N rl s e.
    Hypothesis is_fair : fair V N rl s e.
    Notation at_ := (at_ V s).
    Variable t : nat.
    Hypothesis all_known : known V N s t.

    Lemma maps_stay : forall n i, t <= n -> i < N ->
      explored (at_ (S n) i) = explored (at_ n i) /\ blocked (at_ (S n) i) = blocked (at_ n i).
    Proof. intros n i L I; destruct (all_known n i L I), (all_known (S n) i ltac:(lia) I); split; congruence. Qed.
    Notation self_step := (self_step V same cells obstacle N same_spec rl s e goes_on).
    Notation is_placed := (is_placed V same cells beside obstacle N same_spec beside_cells rl rl_lasting s e goes_on).

    (** A robot that decides has an aim then; one that has an aim and looks is settled then, on its way or because it has
        met another one; and one that is settled is nearer when it arrives. *)
    Lemma act : forall n i, t <= n -> i < N -> acts V i (e n) = true ->
      weight (at_ (S n) i) <= weight (at_ n i)
      /\ (doing (at_ n i) = Stands -> aimed (at_ (S n) i))
      /\ (aimed (at_ n i) -> aimed (at_ (S n) i) /\ match doing (at_ n i) with
          | Stands => True
          | Tries v => news (at_ (S n) i) = false /\ (doing (at_ (S n) i) = Enters v \/ aim (at_ (S n) i) = None)
          | Enters _ => settled (at_ n i) = true -> weight (at_ (S n) i) < weight (at_ n i)
          end).
    Proof.
      intros n i L I Ac; destruct (maps_stay n i L I) as [E B].
      pose proof (step_aim _ _ _ (proj2 goes_on n) i I) as A; rewrite Ac in A; fold (at_ n i) (at_ (S n) i) in A.
      pose proof (step_news _ _ _ (proj2 goes_on n) i I E B) as Nw; fold (at_ n i) (at_ (S n) i) in Nw.
      destruct (self_step n i I) as [[X _]|[_ O]]; [congruence|].
      remember (self V (at_ (S n) i)) as x eqn:X; unfold self in X.
      assert (settled (at_ n i) = false -> weight (at_ (S n) i) <= weight (at_ n i)) as Un.
      { intros U; unfold weight at 2; rewrite U. destruct (settled (at_ (S n) i)) eqn:U'; [apply settled_weight in U'; lia|].
        unfold weight; rewrite U'; lia. }
      assert (forall p, place (at_ (S n) i) = p -> targets (at_ (S n) i) p = targets (at_ n i) p) as Ta
        by (intros p _; unfold Explorers.targets; now rewrite E, B).
      assert (place (at_ (S n) i) = place (at_ n i) -> near (at_ (S n) i) = near (at_ n i)
        /\ forall c, firsts (at_ (S n) i) c = firsts (at_ n i) c) as Al.
      { intros P; destruct (nearest_alike V same cells beside (at_ (S n) i) (at_ n i)) as [Ne Fi]; [repeat split; congruence|].
        split; [|exact Fi]. unfold ExplorersEnd.near; rewrite Ne, E, P; reflexivity. }
      destruct (e n) as [j v c ms|j ms un sl|j ms|] eqn:Ev; cbn in O; change (robots (s n) i) with (at_ n i) in O; [| | |destruct O].
      - destruct O as [_ [M [C O]]]; rewrite O in X; injection X as P D W. destruct (Al (eq_sym P)) as [Ne Fi].
        apply (proj2 rl_keeping) in C; destruct C as [C1 [C2 C3]]; fold (at_ n i) in C1, C2, C3.
        assert (doing (at_ n i) = Stands) as St by (unfold may_decide, moves, ExplorersEnd.at_ in *; destruct (doing (robots (s n) i)); auto; discriminate).
        assert (aimed (at_ (S n) i)) as Ai by (unfold aimed; rewrite A, <- D, Fi, (Ta _ eq_refl), <- P; auto).
        rewrite St; split; [|auto]. destruct (settled (at_ n i)) eqn:Sd; [|now apply Un].
        apply settled_iff in Sd as [Sn Sa]; pose proof (proj2 (settled_iff _) (conj Sn Sa)) as Sd.
        assert (settled (at_ (S n) i) = true) as Se by (apply settled_iff; split; [congruence | exact Ai]).
        assert (most (at_ (S n) i) <= most (at_ n i)) as Mo.
        { unfold most; rewrite A, E, <- P; specialize (C3 Sn); unfold aimed in Sa; destruct (aim (at_ n i)) as [a|]; [now apply C3|].
          rewrite (near_spec V same cells beside same_spec beside_cells _ c); [reflexivity | exact C3]. }
        unfold weight; rewrite Sd, Se, Ne; destruct (most (at_ (S n) i) =? _) eqn:Q, (most (at_ n i) =? _) eqn:Q'; try lia.
        apply Nat.eqb_eq in Q'; apply Nat.eqb_neq in Q; pose proof (settled_most _ Se); lia.
      - destruct O as [-> [v [D O]]]; rewrite D; specialize (A v D); rewrite Nat.eqb_refl in Nw.
        assert (aimed (at_ n i) -> late V same rl (at_ n i) v = false) as Nl.
        { intros S'; unfold aimed, late in *; destruct (aim (at_ n i)) as [a|]; [|apply andb_false_r].
          apply not_true_iff_false; rewrite !andb_true_iff; intros [[_ Ex] Sa]; apply same_spec in Sa; subst a.
          apply (has_in V same cells beside same_spec beside_cells) in Ex; destruct S' as [S' _].
          apply targets_spec in S'; auto; tauto. }
        assert (aimed (at_ n i) -> news (at_ (S n) i) = false) as Nw'.
        { intros S'; rewrite Nw; unfold goes_back; fold (at_ n i); rewrite D; destruct (meets _ _ _ _ _ _); [|reflexivity].
          now rewrite (Nl S'), andb_false_r. }
        assert (aimed (at_ n i) -> aimed (at_ (S n) i) /\ near (at_ (S n) i) = near (at_ n i)
          /\ ((doing (at_ (S n) i) = Enters v /\ most (at_ (S n) i) = most (at_ n i)) \/ aim (at_ (S n) i) = None)) as Core.
        { intros S'; pose proof (Nl S') as La; unfold aimed in S'; destruct (aim (at_ n i)) as [a|] eqn:Aim; [|congruence].
          rewrite D in S'; destruct S' as [S1 S2]; rewrite La in O, A.
          destruct O as [[Me O]|[Me O]], A as [[Me' A]|[[Me' [Ob A]]|[Me' [Ob A]]]]; try congruence.
          - exfalso; rewrite B in A; apply targets_spec in S1; auto; apply firsts_spec in S2; auto.
            destruct S2 as [_ [[->|S2] _]]; [tauto|].
            destruct (FRONTIER_5 V same cells beside obstacle N same_spec beside_cells _ _ (runs V same cells obstacle N rl s e goes_on n) i I) as [F _].
            apply F in S2; apply (free_always V same cells obstacle N same_spec rl (s n)) in S2;
              [congruence | apply (runs V same cells obstacle N rl s e goes_on)].
          - rewrite O, Ob in X; cbn [orb] in X; injection X as P D' W; destruct (Al (eq_sym P)) as [Ne Fi]; split; [|split; [exact Ne|]].
            + unfold aimed; rewrite A, <- D', Fi, (Ta _ eq_refl), <- P; auto.
            + left; split; [auto|]; unfold most; now rewrite A, Aim, E, <- P.
          - rewrite O in X; injection X as P D' W; destruct (Al (eq_sym P)) as [Ne Fi].
            split; [unfold aimed; now rewrite A | split; [exact Ne | now right]]. }
        split; [|split; [congruence|]; intros S'; destruct (Core S') as [Ai [_ [[D' _]|A']]]; auto].
        destruct (settled (at_ n i)) eqn:Sd; [|now apply Un]. pose proof (settled_most _ Sd) as Mo.
        pose proof (proj1 (settled_iff _) Sd) as [_ Sa]; destruct (Core Sa) as [Ai [Ne H]].
        assert (settled (at_ (S n) i) = true) as Se by (apply settled_iff; auto).
        unfold weight; rewrite Sd, Se, Ne; destruct H as [[_ ->]|A']; [lia|].
        unfold most at 1 2; rewrite A', Ne, Nat.eqb_refl; lia.
      - destruct O as [-> [v [D O]]]; rewrite D; specialize (A v D); rewrite O in X; injection X as P D' W.
        rewrite (proj1 rl_keeping) in A; cbn [andb] in A.
        assert (aimed (at_ n i) -> aimed (at_ (S n) i) /\ S (most (at_ (S n) i)) = most (at_ n i)) as Core.
        { intros S'; unfold aimed in S'; destruct (aim (at_ n i)) as [a|] eqn:Aim; [|congruence].
          rewrite D in S'; destruct S' as [S1 S2]; apply targets_spec in S1; auto; apply firsts_spec in S2; auto.
          destruct (is_placed (S n) i I) as [_ [Pl _]]; fold (at_ (S n) i) in Pl; rewrite <- P, E in Pl.
          assert (same a v = false) as Ne by (apply not_true_iff_false; intros Q; apply same_spec in Q; subst; tauto). rewrite Ne in A; cbn [negb] in A.
          assert (v <> a) as Na by (intros ->; tauto). split.
          - unfold aimed; rewrite A, <- D'; split; [|trivial]. rewrite <- P, (Ta _ (eq_sym P)); apply targets_spec; auto.
            repeat split; try tauto; lia.
          - unfold most; rewrite A, Aim, E, <- P; tauto. }
        assert (settled (at_ n i) = true -> weight (at_ (S n) i) < weight (at_ n i)) as Lt.
        { intros Sd; pose proof (proj1 (settled_iff _) Sd) as [Sn Sa]; destruct (Core Sa) as [Ai Mo].
          assert (settled (at_ (S n) i) = true) as Se by (apply settled_iff; split; [congruence | exact Ai]).
          unfold weight; rewrite Sd, Se; destruct (_ =? _), (_ =? _); lia. }
        split; [|split; [congruence | intros S'; split; [apply Core, S' | exact Lt]]].
        destruct (settled (at_ n i)) eqn:Sd; [specialize (Lt eq_refl); lia | now apply Un].
    Qed.
    Lemma weight_step : forall n i, t <= n -> i < N -> weight (at_ (S n) i) <= weight (at_ n i)
      /\ (aimed (at_ n i) -> aimed (at_ (S n) i)).
    Proof.
      intros n i L I; destruct (acts V i (e n)) eqn:A.
      { destruct (act n i L I A) as [W [_ H]]; split; [exact W | intros S'; now apply H]. }
      destruct (self_step n i I) as [[_ Se]|[X _]]; [|congruence]. destruct (maps_stay n i L I) as [E B].
      pose proof (step_aim _ _ _ (proj2 goes_on n) i I) as Am; rewrite A in Am.
      pose proof (step_news _ _ _ (proj2 goes_on n) i I E B) as Nw.
      assert (news (at_ (S n) i) = news (at_ n i)) as Nn
        by (unfold ExplorersEnd.at_; rewrite Nw; destruct (e n) as [j v c ms|j ms un sl|j ms|]; auto; cbn in A; now rewrite A).
      pose proof (self_eq V _ _ Se) as [P [D _]]; assert (alike_maps V (at_ (S n) i) (at_ n i)) as Al by (repeat split; auto).
      split; [rewrite (weight_alike _ _ Al); auto|]. destruct (nearest_alike V same cells beside _ _ Al) as [_ Fi].
      unfold aimed; fold (at_ (S n) i) (at_ n i) in Am; rewrite Am, D. unfold Explorers.targets; rewrite E, B, P.
      destruct (aim (at_ n i)); [|auto]. now rewrite !Fi.
    Qed.

    (** In the end nobody arrives, and all go to nearest cells. *)
    Hypothesis all_weigh : forall n i, t <= n -> i < N -> weight (at_ n i) = weight (at_ t i).
    Lemma settled_plain : forall n i v c ms, t <= n -> e n = Decides i v c ms ->
      In c (nearest (at_ n i)) /\ In v (firsts (at_ n i) c).
    Proof.
      intros n i v c ms L Ev.
      assert (i < N) as I.
      { destruct (proj2 goes_on n) as [x [X _]]; rewrite Ev in X; cbn [next] in X; destruct (i <? N) eqn:I; [now apply Nat.ltb_lt | discriminate]. }
      assert (acts V i (e n) = true) as A by (rewrite Ev; apply Nat.eqb_refl).
      destruct (self_step n i I) as [[X _]|[_ O]]; [congruence|]. rewrite Ev in O; destruct O as [_ [M [C O]]].
      apply (proj2 rl_keeping) in C; destruct C as [C1 [C2 C3]]; fold (at_ n i) in C1, C2, C3. split; [|exact C2].
      assert (doing (at_ n i) = Stands) as St by (unfold may_decide, moves, ExplorersEnd.at_ in *; destruct (doing (robots (s n) i)); auto; discriminate).
      assert (forall m, t <= m -> weight (at_ m i) = weight (at_ n i)) as Co
        by (intros m Lm; rewrite (all_weigh m i Lm I), (all_weigh n i L I); reflexivity).
      unfold self in O; injection O as _ D _; fold (at_ (S n) i) in D.
      assert (forall m, S n <= m -> aimed (at_ m i)) as Ai.
      { intros m Lm; induction Lm as [|m Lm IH]; [exact (proj1 (proj2 (act n i L I A)) St) | exact (proj2 (weight_step m i ltac:(lia) I) IH)]. }
      destruct (flier_acts V same cells obstacle N same_spec rl s e goes_on is_fair i (S n) I) as [m [Lm [Am Sm]]].
      { apply flying_moves; unfold flying; rewrite D; discriminate. }
      apply self_eq in Sm; destruct Sm as [_ [Sm _]]; rewrite D in Sm.
      destruct (act m i ltac:(lia) I Am) as [_ [_ H]]; rewrite Sm in H; destruct (H (Ai m Lm)) as [Aim [Nw G]].
      pose proof (proj2 (settled_iff _) (conj Nw Aim)) as Se.
      assert (forall m, t <= m -> settled (at_ m i) = true) as All.
      { intros k Lk; apply settled_weight; rewrite (Co k Lk), <- (Co (S m)) by lia; now apply settled_weight. }
      destruct (most (at_ n i) =? near (at_ n i)) eqn:Q.
      - apply Nat.eqb_eq in Q; pose proof (proj1 (settled_iff _) (All n L)) as [Sn Sa]; specialize (C3 Sn); unfold aimed in Sa.
        unfold most in Q; destruct (aim (at_ n i)) as [a|]; [|exact C3]. specialize (C3 (proj1 Sa)).
        apply nearest_spec; auto; split; [exact C1|]; intros d Id.
        apply (near_most V same cells beside same_spec beside_cells) in Id; lia.
      - exfalso; assert (forall m, t <= m -> weight (at_ m i) = 2 * most (at_ n i) + 1) as Odd
          by (intros k Lk; rewrite (Co k Lk); unfold weight; now rewrite (All n L), Q).
        destruct G as [G|G].
        + destruct (flier_acts V same cells obstacle N same_spec rl s e goes_on is_fair i (S m) I) as [k [Lk [Ak Sk]]].
          { apply flying_moves; unfold flying; rewrite G; discriminate. }
          apply self_eq in Sk; destruct Sk as [_ [Sk _]]; rewrite G in Sk.
          destruct (act k i ltac:(lia) I Ak) as [_ [_ W]]; rewrite Sk in W; specialize (proj2 (W (Ai k ltac:(lia))) (All k ltac:(lia))) as Lt.
          rewrite (Odd k), (Odd (S k)) in Lt by lia; lia.
        + pose proof (Odd (S m) ltac:(lia)) as X; unfold weight in X; rewrite Se in X; unfold most at 1 2 in X.
          rewrite G, Nat.eqb_refl in X; lia.
    Qed.
  End Endless.

  Theorem keeping_ends : forall s e, endless V same cells obstacle N rl s e -> fair V N rl s e ->
    (exists t, forall n, t <= n -> missed V (e n) = false) -> False.
  Proof.
    intros s e G F M; apply (constant (fun n => learnt V cells N s n)); [apply (learnt_falls V same cells obstacle N rl s e G)|].
    intros t1 K; apply (learnt_same V same cells beside obstacle N same_spec beside_cells rl rl_lasting s e G) in K.
    apply (constant (fun k => total N (fun i => weight (at_ V s (t1 + k) i)))).
    { intros k; apply total_le; intros i I; rewrite Nat.add_succ_r; apply (weight_step s e G t1 K (t1 + k) i); auto; lia. }
    intros k C; assert (known V N s (t1 + k)) as K'.
    { intros n i L I; destruct (K n i ltac:(lia) I) as [-> ->], (K (t1 + k) i ltac:(lia) I) as [-> ->]; auto. }
    apply (plain_in_the_end_ends V same cells beside obstacle N same_spec beside_cells rl rl_lasting s e G F); [|exact M].
    exists (t1 + k); intros n i v c ms L; apply (settled_plain s e G F (t1 + k) K'); [|exact L].
    clear n L; intros n j L J; replace n with (t1 + (n - t1)) by lia.
    assert (forall m, k <= m -> forall j, j < N -> weight (at_ V s (t1 + m) j) <= weight (at_ V s (t1 + k) j)) as Le.
    { intros m Lm; induction Lm as [|m Lm IH]; intros x X; [lia|]. rewrite Nat.add_succ_r; specialize (IH x X).
      pose proof (proj1 (weight_step s e G t1 K (t1 + m) x ltac:(lia) X)); lia. }
    apply (total_same N (fun i => weight (at_ V s (t1 + k) i)) (fun i => weight (at_ V s (t1 + (n - t1)) i)));
      [apply Le; lia | apply C; lia | exact J].
  Qed.
End Area.

(** FRONTIER-3, repaired. *)
Theorem paired_lasting : forall V same cells beside N number rim k, (forall a b : V, same a b = true <-> a = b) ->
  (forall u v : V, In v (beside u) -> In v cells) -> lasting V same cells beside (PAIRED V same cells beside N number rim k).
Proof.
  intros V same cells beside N number rim k S B; split; [now apply paired_sensible|]. intros i r T; cbn [chooses PAIRED].
  unfold pairs at 1; cbn [fst]; now rewrite T.
Qed.
Theorem repaired_keeping : forall V same cells beside N number rim, (forall a b : V, same a b = true <-> a = b) ->
  (forall u v : V, In v (beside u) -> In v cells) -> keeping V same cells beside (REPAIRED V same cells beside N number rim).
Proof.
  intros V same cells beside N number rim S B; split; [reflexivity|]. intros i r v c I.
  apply (paired_spec V same cells beside N S B) in I; destruct I as [T [F H]]; split; [exact T|]; split; [exact F | exact (H eq_refl)].
Qed.
Theorem FRONTIER_3 : forall (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool)
  (N : nat) (number rim : V -> nat), (forall a b, same a b = true <-> a = b) -> (forall u v, In v (beside u) -> In v cells) ->
  forall s e, endless V same cells obstacle N (REPAIRED V same cells beside N number rim) s e ->
  fair V N (REPAIRED V same cells beside N number rim) s e ->
  (exists t, forall n, t <= n -> missed V (e n) = false) -> False.
Proof.
  intros V same cells beside obstacle N number rim S B.
  apply (keeping_ends V same cells beside obstacle N S B); [now apply paired_lasting | now apply repaired_keeping].
Qed.
