(** Tasks that are lists of team moves, a player of Reel.v that computes, and runs in which each habit of the reel is
    needed. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Replay Reach Reel.
Import ListNotations.

(** A task that is a list of team moves: the first of them is next, if it is admitted and no wall is known to be in its
    way. *)
Definition script : Type := list (list step).

Section Scripts.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge) (habit : habits).

  Definition follows (m : chart) (open : list edge) (t : script) (p : list cell) : option (list step * script) :=
    match t with
    | [] => None
    | pl :: t => if admits N rl base open p pl && is_free N m p pl then Some (pl, t) else None
    end.

  Lemma admits_more : forall open open' p pl, (forall e, has open e = true -> has open' e = true) ->
    admits N rl base open p pl = true -> admits N rl base open' p pl = true.
  Proof.
    intros o o' p pl O A. unfold admits, admitted in *; rewrite !andb_true_iff in *.
    destruct A as [[[A1 A2] A3] A4]; repeat split; auto. rewrite every_spec in *; intros i L; specialize (A2 i L).
    unfold admits_ahead in *. apply andb_true_iff in A2; destruct A2 as [A2 U]; apply andb_true_iff; split; [exact A2|].
    apply orb_true_iff in U; apply orb_true_iff; destruct U as [U|U]; [left | right; exact U].
    apply negb_true_iff, orb_false_iff in U; destruct U as [H U]; apply negb_true_iff; rewrite H; cbn [orb].
    apply andb_false_iff in U; apply andb_false_iff; destruct U as [U|U]; [now left | right].
    apply negb_false_iff in U; apply negb_false_iff. unfold is_sure, as_move in *.
    cbn [does known_open pos open state_of opened places] in *. destruct (plan_of pl (S i)); [now apply O | exact U].
  Qed.

  Lemma scripts_sound : sound_steps N rl base script follows.
  Proof.
    split.
    - intros m o t p pl t' E; destruct t as [|q t]; cbn in E; [discriminate|].
      destruct (admits _ _ _ _ _ _ && is_free _ _ _ _) eqn:A; [|discriminate]; injection E as <- _.
      now apply andb_true_iff in A.
    - intros m o t p pl t' E; destruct t as [|q t]; cbn in E; [discriminate|].
      destruct (admits _ _ _ _ _ _ && is_free _ _ _ _) eqn:A; [|discriminate]; injection E as <- _.
      now apply andb_true_iff in A.
    - intros m o o' t p r O E; destruct t as [|q t]; cbn in *; [discriminate|].
      destruct (admits N rl base o p q && is_free N m p q) eqn:A; [|discriminate]; apply andb_true_iff in A;
        destruct A as [A B]. now rewrite (admits_more o o' p q O A), B.
  Qed.

  (** ** A player that computes, and that plays nothing but team moves of Reel.v. *)
  Inductive said := Touch (pl : list step) | On | Begin (t : script) | BackOn | Back.

  Notation reel := (reel script).
  Notation memory := (memory script).

  Definition is_idle_now (x : reel) : bool :=
    match is_at (remembers x) with
    | Nothing => true
    | At t _ => negb (keeps_task habit) || match goes_on script follows x t with None => true | Some _ => false end
    | TakingBack more => (more =? 0) || match made_so_far (team_at x) with [] => true | _ :: _ => false end
    end.

  Definition planned_by (x : reel) (e : said) : option (team_move * memory) :=
    let p := places (team_at x) in
    match e with
    | Touch pl =>
        if admits N rl base (opened (team_at x)) p pl && is_free N (chart_of x) p pl
           && negb (is_in (seen (chart_of x)) (after (team_of p (pred N)) (nth (pred N) pl Stay)))
        then Some (Advance pl, fresh script) else None
    | On =>
        match is_at (remembers x) with
        | At t more =>
            if keeps_task habit then
              match goes_on script follows x t with
              | Some (pl, t) => Some (Advance pl, {| is_at := At t more; begun := begun (remembers x) |})
              | None => None
              end
            else None
        | Nothing | TakingBack _ => None
        end
    | Begin t =>
        if is_idle_now x
           && (negb (rehearses habit)
               || explores_in N script follows (List.length t) (chart_of x) (opened (team_at x)) t p)
        then match goes_on script follows x t with
             | Some (pl, t) => Some (Advance pl, {| is_at := At t (S (List.length t)); begun := begun (remembers x) |})
             | None => None
             end
        else None
    | BackOn =>
        match is_at (remembers x), made_so_far (team_at x) with
        | TakingBack (S _), pl :: _ => Some (back N pl, remembers x)
        | _, _ => None
        end
    | Back =>
        match made_so_far (team_at x) with
        | pl :: _ =>
            if is_idle_now x
            then Some (back N pl, {| is_at := TakingBack (many (begun (remembers x)));
              begun := if doubles habit then Nat.min (S (begun (remembers x))) 255 else begun (remembers x) |})
            else None
        | [] => None
        end
    end.

  Lemma idle_now : forall x, is_idle_now x = true -> is_idle habit script follows x.
  Proof.
    intros x I; unfold is_idle, is_idle_now in *. destruct (is_at (remembers x)) as [|t more|more]; [exact Logic.I | |].
    - destruct (keeps_task habit); [|exact Logic.I]. destruct (goes_on _ _ _ _); [discriminate | reflexivity].
    - apply orb_true_iff in I; destruct I as [I|I]; [left; now apply Nat.eqb_eq | right].
      now destruct (made_so_far (team_at x)).
  Qed.

  Lemma planned_plans : forall x e mv m, planned_by x e = Some (mv, m) -> plans N rl base habit script follows x mv m.
  Proof.
    intros x e mv m E; destruct e as [pl| |t| |]; cbn [planned_by] in E.
    - destruct (_ && _) eqn:A in E; [|discriminate]; injection E as <- <-. rewrite !andb_true_iff in A.
      destruct A as [[A B] C]. apply plans_touch; split; [exact A|]. split; [exact B | now apply negb_true_iff].
    - destruct (is_at (remembers x)) as [|t more|more] eqn:A; try discriminate.
      destruct (keeps_task habit) eqn:K; [|discriminate].
      destruct (goes_on _ _ _ _) as [[pl t']|] eqn:G; [|discriminate]; injection E as <- <-.
      eapply plans_on; eauto.
    - destruct (_ && _) eqn:A in E; [|discriminate]. apply andb_true_iff in A; destruct A as [A B].
      destruct (goes_on _ _ _ _) as [[pl t']|] eqn:G; [|discriminate]; injection E as <- <-.
      assert (List.length t = S (List.length t')) as L.
      { unfold goes_on in G; destruct t as [|q t]; cbn in G; [discriminate|].
        destruct (_ && _) in G; [|discriminate]; injection G as _ <-; reflexivity. }
      eapply plans_task; [now apply idle_now | lia | | exact G]. intros R; rewrite R in B; rewrite <- L; exact B.
    - destruct (is_at (remembers x)) as [|t more|[|more]] eqn:A; try discriminate.
      destruct (made_so_far (team_at x)) as [|pl rest] eqn:H; [discriminate|]; injection E as <- <-.
      eapply plans_back_on; eauto.
    - destruct (made_so_far (team_at x)) as [|pl rest] eqn:H; [discriminate|].
      destruct (is_idle_now x) eqn:A; [|discriminate]; injection E as <- <-.
      eapply plans_back; [now apply idle_now | exact H].
  Qed.

  Definition plays (x : reel) (e : said) : option (team_move * memory * reel) :=
    match planned_by x e with
    | Some (mv, m) =>
        match next N rl base walls (team_at x) mv with
        | Some t =>
            let gain := explores (chart_of x) (places t) || finds N walls (chart_of x) (team_at x) mv in
            Some (mv, m, {| team_at := t; chart_of := learns N walls (chart_of x) (team_at x) t mv;
              mind := if gain then m else went_on m; gained := gain; moves_made := S (moves_made x) |})
        | None => None
        end
    | None => None
    end.

  Lemma plays_moves : forall x e mv m y, plays x e = Some (mv, m, y) ->
    moves N rl base walls habit script follows x mv m y.
  Proof.
    intros x e mv m y E; unfold plays in E. destruct (planned_by x e) as [[mv' m']|] eqn:P; [|discriminate].
    destruct (next _ _ _ _ _ _) as [t|] eqn:X; [|discriminate]; injection E as <- <- <-.
    apply moves_so; [eapply planned_plans; eauto | exact X].
  Qed.

  Fixpoint plays_all (x : reel) (l : list said) : option reel :=
    match l with
    | [] => Some x
    | e :: l => match plays x e with Some (_, _, y) => plays_all y l | None => None end
    end.
  Lemma plays_runs : forall l x y, runs N rl base walls known habit script follows x -> plays_all x l = Some y ->
    runs N rl base walls known habit script follows y.
  Proof.
    induction l as [|e l IH]; intros x y R E; cbn in E; [now injection E as <-|].
    destruct (plays x e) as [[[mv m] z]|] eqn:P; [|discriminate].
    eapply IH; [|exact E]. eapply runs_on; [exact R | eapply plays_moves; eauto].
  Qed.
End Scripts.

(** ** Each habit is needed: two robots in the open, and a measure that rises without a gain. *)
Definition rises (habit : habits) (l : list said) (e : said) : bool :=
  let o := (0, 0)%Z in
  match plays_all 2 REEL o [] habit (begins 2 o [] script) l with
  | Some x =>
      match plays 2 REEL o [] habit x e with
      | Some (_, m, y) =>
          let '(a, b, c) := measure m in let '(a', b', c') := measure (mind x) in
          negb (gained x) && negb (gained y) && (moves_made x <? 9) && (a =? a') && (b =? b') && (c' <? c)
      | None => false
      end
  | None => false
  end.

Lemma rises_not_falls : forall habit l e, rises habit l e = true ->
  ~ measure_falls 2 REEL (0, 0)%Z [] [] habit script (follows 2 REEL (0, 0)%Z).
Proof.
  intros habit l e E F; unfold rises in E. destruct (plays_all _ _ _ _ _ _ _) as [x|] eqn:X; [|discriminate].
  destruct (plays _ _ _ _ _ _ _) as [[[mv m] y]|] eqn:Y; [|discriminate].
  destruct (measure m) as [[a b] c] eqn:M; destruct (measure (mind x)) as [[a' b'] c'] eqn:M'.
  rewrite !andb_true_iff, !negb_true_iff in E; destruct E as [[[[[G G'] K] A] B] C].
  apply Nat.ltb_lt in K, C; apply Nat.eqb_eq in A, B; subst.
  destruct (F x mv m y) as [_ [H|[H|[H|H]]]]; try congruence.
  - eapply plays_runs; [apply runs_start | exact X].
  - assert (2 ^ 4 <= 2 ^ 32) by (apply Nat.pow_le_mono_r; lia). change (2 ^ 4) with 16 in H. lia.
  - eapply plays_moves; eauto.
  - rewrite M, M' in H; injection H as ->; lia.
  - rewrite M, M' in H; unfold below in H; lia.
Qed.

Theorem each_habit_is_needed :
  let fails habit := ~ measure_falls 2 REEL (0, 0)%Z [] [] habit script (follows 2 REEL (0, 0)%Z) in
  fails (Build_habits false true true) /\ fails (Build_habits true false true) /\ fails (Build_habits true true false).
Proof.
  set (wait := [Stay; Stay]). set (east := [Stay; Cross East]). set (south := [Stay; Cross South]).
  split; [|split].
  - now apply rises_not_falls with (l := [Begin [wait]]) (e := Begin [wait]).
  - now apply rises_not_falls with (l := [Begin [wait; east]]) (e := Begin [wait; wait; east]).
  - now apply rises_not_falls with (l := [Begin [east]; Begin [south]; Back]) (e := Back).
Qed.
